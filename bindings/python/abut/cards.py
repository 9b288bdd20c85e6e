"""Cards of a deck: fields of 10 and 20 columns from Python values and arrays, checked."""
from __future__ import annotations

import math
import operator
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

DIRECTIONS = ("X", "Y", "Z", "XX", "YY", "ZZ")


def real(value: float) -> str:
    """A finite number in 20 columns, with as many digits as fit: at least 13, all 17 for most."""
    text = repr(finite(value, "a number of the card"))
    digits = 16
    while len(text) > 20:
        text = f"{float(value):.{digits}g}"
        digits -= 1
    return f"{text:>20}"


def reals(*values: float) -> str:
    return "".join(real(value) for value in values)


def integer(value: int, name: str) -> int:
    try:
        return int(operator.index(value))
    except TypeError:
        raise TypeError(f"{name} is {value!r}, expected an integer") from None


def integers(*values: int | str) -> str:
    """Integers in 10 columns each; "" leaves a field empty."""
    return "".join(_field(value) for value in values)


def _field(value: int | str) -> str:
    text = str(value) if type(value) is int or isinstance(value, str) else str(integer(value, "a field of the card"))
    if len(text) > 10:
        raise ValueError(f"{text} has {len(text)} characters, at most 10 fit in a field of a card")
    return f"{text:>10}"


def check_ids(**ids: int) -> None:
    """Positive integers, by the names of the arguments."""
    for name, value in ids.items():
        if integer(value, name) < 1:
            raise ValueError(f"{name} is {value}: ids are positive")


def check_integers(**values: int) -> None:
    """Integers, by the names of the arguments."""
    for name, value in values.items():
        integer(value, name)


def check_finite(**values: float) -> None:
    """Finite numbers, by the names of the arguments."""
    for name, value in values.items():
        finite(value, name)


def checked_text(value: str, name: str) -> str:
    """One line that cannot be taken for a keyword or a comment."""
    if any(ord(character) < 32 for character in value) or value.startswith(("/", "#", "$")):
        raise ValueError(f"{name} {value!r} must be one line that does not begin with /, # or $")
    if len(value) > 100:
        raise ValueError(f"{name} has {len(value)} characters, at most 100 fit on a card")
    return value


def finite(value: float, name: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}, expected a number") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} is {value}, expected a finite number")
    return number


def nonzero(value: float, name: str) -> float:
    """A finite number other than 0, which the card would take for its default."""
    number = finite(value, name)
    if number == 0.0:
        raise ValueError(f"{name} is 0, expected another number: a card takes 0 for its default value, not for none")
    return number


def positive(value: float, name: str) -> float:
    number = finite(value, name)
    if not number > 0.0:
        raise ValueError(f"{name} is {value}, expected a positive number")
    return number


def real_array(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """Of any shape; complex numbers are not cut to their real part."""
    array = np.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} holds {array.dtype}, expected real numbers")
    return array.astype(np.float64)


def vectors(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """(N, 3) finite numbers."""
    array = real_array(value, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has shape {array.shape}, expected (N, 3)")
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if bad.size > 0:
        raise ValueError(f"{name}: row {bad[0]} is not finite")
    return array


def vector(value: ArrayLike, name: str) -> NDArray[np.float64]:
    array = real_array(value, name)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(f"{name} is {array.tolist()}, expected three finite numbers")
    return array


def id_array(value: ArrayLike, name: str, columns: Sequence[int] = ()) -> NDArray[np.int64]:
    """(K,) positive integers, or (K, c) with c among `columns`."""
    array = np.asarray(value)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} holds {array.dtype}, expected integers (ids)")
    if columns:
        if array.ndim != 2 or array.shape[1] not in columns:
            raise ValueError(f"{name} has shape {array.shape}, expected {' or '.join(f'(K, {c})' for c in columns)}")
    elif array.ndim != 1:
        raise ValueError(f"{name} has shape {array.shape}, expected (K,)")
    if array.size > 0 and array.min() < 1:
        raise ValueError(f"{name} holds {array.min()}: ids are positive (nodes() returns those of its nodes)")
    if array.size > 0 and len(str(array.max())) > 10:
        raise ValueError(f"{name} holds {array.max()}: ids on a card have at most 10 digits")
    return array.astype(np.int64)


def in_rows(fields: Iterable[int | str], width: int = 10) -> list[str]:
    """Ids or names, ten a card."""
    listed = list(fields)
    return [integers(*listed[k:k + width]) for k in range(0, len(listed), width)]


def names(values: Sequence[str], name: str) -> list[str]:
    """Words that fit in a field of a card, at least one."""
    if isinstance(values, str):
        raise TypeError(f"{name} is {values!r}, expected a list of names, e.g. [{values!r}]")
    listed = list(values)
    for word in listed:
        if not (isinstance(word, str) and word.isascii() and word.isidentifier() and len(word) <= 10):
            raise ValueError(f"{name} holds {word!r}, expected names of 1 to 10 letters, digits and _")
    if not listed:
        raise ValueError(f"{name} is empty, expected at least one name")
    return listed


def block(text: str, name: str, own: Sequence[str]) -> list[str]:
    """Lines of whole blocks: the first is a keyword line. None is of the keywords `own`, which the builder writes."""
    if not text.startswith("/"):
        raise ValueError(f"{name} is {text!r}, but a block begins with its keyword line, e.g. '/GRAV/1'")
    lines = text.rstrip("\n").split("\n")
    for line in lines:
        keyword = "/" + line[1:].split("/")[0].strip() if line.startswith("/") else line.strip()
        if keyword.upper() in own:
            raise ValueError(f"{name} holds {line!r}, but {' and '.join(own)} are written by the builder: leave this line and what "
                             f"belongs to it out")
    return lines


def direction(value: str, rotations: bool = True) -> str:
    allowed = DIRECTIONS if rotations else DIRECTIONS[:3]
    word = value.upper()
    if word not in allowed:
        raise ValueError(f"direction is {value!r}, expected one of {', '.join(allowed)}")
    return word


def axes(value: str, name: str) -> str:
    """'xz' to '101'."""
    word = value.lower()
    if any(letter not in "xyz" for letter in word):
        raise ValueError(f"{name} is {value!r}, expected letters out of 'xyz'")
    return "".join("1" if letter in word else "0" for letter in "xyz")
