"""Time histories: named columns over time."""
from __future__ import annotations

import csv
import fnmatch
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray


class History(Mapping[str, NDArray[np.float64]]):
    """Columns of a time history by name, e.g. history["GLOBAL/KE"]: (R,) arrays, views of `table`.

    Names and units are those of NAME_th.csv (docs/guide/outputs.md). The first column is "time".
    """

    def __init__(self, names: Sequence[str], values: ArrayLike) -> None:
        """names: C columns; values: (R, C), one row per state."""
        table = np.asarray(values, dtype=np.float64)
        if table.ndim != 2 or table.shape[1] != len(names):
            raise ValueError(f"values has shape {table.shape}, expected (R, {len(names)})")
        self._names = list(names)
        self._column = {name: k for k, name in enumerate(self._names)}
        self._values = table

    @staticmethod
    def read(path: str | os.PathLike[str]) -> History:
        """Reads NAME_th.csv, or the one of a run folder; also while it is written: a last line without its end is left out."""
        file = Path(path)
        if file.is_dir():
            found = sorted(file.glob("*_th.csv"))
            if len(found) != 1:
                raise FileNotFoundError(f"{file} holds {len(found)} files *_th.csv, expected one")
            file = found[0]
        text = file.read_text(encoding="utf-8")
        rows = csv.reader(text.rpartition("\n")[0].split("\n"))  # the last line of a run that goes on may not be whole
        names: list[str] = next(rows, [])
        values = [[float(value) for value in row] for row in rows if len(row) == len(names)]
        return History(names, np.array(values, dtype=np.float64).reshape(len(values), len(names)))

    @property
    def names(self) -> list[str]:
        """All column names in their order, "time" first."""
        return list(self._names)

    @property
    def table(self) -> NDArray[np.float64]:
        """(R, C) the whole table."""
        return self._values

    @property
    def time(self) -> NDArray[np.float64]:
        """(R,) the column "time"."""
        return self["time"]

    def find(self, pattern: str) -> list[str]:
        """Names that fit a pattern with * and ?, e.g. "INTER/*/FN?"."""
        return [name for name in self._names if fnmatch.fnmatchcase(name, pattern)]

    def structured(self) -> NDArray[np.void]:
        """(R,) a copy as a structured array: one field per column."""
        table = np.empty(len(self._values), dtype=[(name, np.float64) for name in self._names])
        for k, name in enumerate(self._names):
            table[name] = self._values[:, k]
        return table

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self._column:
            near = self.find(f"*{name}*")[:5]
            hint = f"; near it: {', '.join(near)}" if near else ""
            raise KeyError(f"'{name}' is not a column of this history{hint}")
        return self._values[:, self._column[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<history of {len(self._names)} columns, {len(self._values)} rows>"
