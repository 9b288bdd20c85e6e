"""The stubs say what the module is: every public name, and every argument with its kind and default."""
import ast
import inspect
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import abut

PACKAGE = Path(abut.__file__).parent
MODULES = {"__init__.pyi": abut, "contact.pyi": abut.contact}


def parameters(arguments, skip_self):
    """[(name, kind, default text)] of an ast.arguments; '...' for a default that is an object."""
    plain = [(a, "positional") for a in arguments.posonlyargs + arguments.args]
    defaults = [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults
    listed = [(a.arg, kind, d) for (a, kind), d in zip(plain, defaults)]
    listed += [(a.arg, "keyword", d) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    if skip_self and listed:
        listed = listed[1:]
    return [(name, kind, None if d is None else ast.unparse(d)) for name, kind, d in listed]


def real_parameters(function, name, skip_self):
    """The same from the first line of a docstring that pybind11 wrote."""
    line = function.__doc__.split("\n", 1)[0]
    text = re.sub(r"<[^<>]*>", "...", line)
    node = ast.parse(f"def {text}: ...").body[0]
    assert node.name == name, line
    return parameters(node.args, skip_self)


def same_default(stub, real):
    if stub is None or real is None:
        return stub is None and real is None
    if stub == "..." or real == "...":
        return stub == real
    return ast.literal_eval(stub) == ast.literal_eval(real)


def compare(stub, real, where):
    assert [p[:2] for p in stub] == [p[:2] for p in real], where
    for (name, _, a), (_, _, b) in zip(stub, real):
        assert same_default(a, b), f"{where}: default of {name} is {b}, the stub says {a}"


def stub_tree(name):
    return ast.parse((PACKAGE / name).read_text(encoding="utf-8"))


def is_static(node):
    return any(isinstance(d, ast.Name) and d.id == "staticmethod" for d in node.decorator_list)


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def is_setter(node):
    return any(isinstance(d, ast.Attribute) and d.attr == "setter" for d in node.decorator_list)


CLASSES = [(file, node) for file in MODULES for node in stub_tree(file).body if isinstance(node, ast.ClassDef)]


@pytest.mark.parametrize("file, node", CLASSES, ids=[f"{file}:{node.name}" for file, node in CLASSES])
def test_class(file, node):
    real = getattr(MODULES[file], node.name)
    assert real.__doc__, f"{node.name} has no docstring"
    if issubclass(real, Exception):
        assert [base.__name__ for base in real.__bases__] == [ast.unparse(base) for base in node.bases]
        return
    said = set()
    for member in node.body:
        if isinstance(member, ast.AnnAssign):
            said.add(member.target.id)
            assert getattr(real, member.target.id).fset is not None, f"{node.name}.{member.target.id} cannot be set"
        elif isinstance(member, ast.FunctionDef):
            where = f"{node.name}.{member.name}"
            said.add(member.name)
            attribute = inspect.getattr_static(real, member.name)
            if is_setter(member):
                assert attribute.fset is not None, where
            elif is_property(member):
                assert isinstance(attribute, property), where
            elif member.name in ("__len__", "__enter__", "__exit__"):
                assert callable(getattr(real, member.name)), where
            else:
                assert isinstance(attribute, staticmethod) == is_static(member), where
                function = getattr(real, member.name)
                compare(parameters(member.args, not is_static(member)), real_parameters(function, member.name, not is_static(member)), where)
    public = {name for name in vars(real) if not name.startswith("_")}
    assert public == {name for name in said if not name.startswith("_")}, node.name
    assert ("__init__" in said) == ("__init__" in vars(real) and "__init__" in (real.__init__.__doc__ or "")), node.name


@pytest.mark.parametrize("file, node", CLASSES, ids=[f"{file}:{node.name}" for file, node in CLASSES])
def test_every_attribute_says_what_it_is(file, node):
    """No public attribute, method or constructor without a docstring; of a function more than the signature that pybind11 writes."""
    real = getattr(MODULES[file], node.name)
    silent = []
    for name in vars(real):
        member = getattr(real, name)
        if name.startswith("_") and not (name == "__init__" and "__init__(" in (member.__doc__ or "")):
            continue
        doc = (member.__doc__ or "").strip()
        if doc.startswith(name + "("):
            doc = doc.partition("\n")[2].strip()
        if not doc:
            silent.append(name)
    assert not silent, f"{node.name}: {silent}"


ARRAYS = re.compile(r"\([0-9A-Za-z, -]+,[0-9A-Za-z, -]*\)")


@pytest.mark.parametrize("file, node", CLASSES, ids=[f"{file}:{node.name}" for file, node in CLASSES])
def test_every_array_says_its_shape(file, node):
    """Properties and functions that give or take arrays name a shape, (N,) or (N, 3), or point to the function that does."""
    real = getattr(MODULES[file], node.name)
    for member in node.body:
        if not isinstance(member, ast.FunctionDef) or is_setter(member):
            continue
        types = [ast.unparse(a.annotation) for a in member.args.args + member.args.kwonlyargs if a.annotation is not None]
        types.append(ast.unparse(member.returns))
        if any("NDArray" in t for t in types):
            doc = getattr(real, member.name).__doc__
            assert ARRAYS.search(doc) or "evaluate()" in doc, f"{node.name}.{member.name}: {doc}"


@pytest.mark.parametrize("file", MODULES)
def test_module(file):
    module, tree = MODULES[file], stub_tree(file)
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name for node in tree.body if isinstance(node, ast.ClassDef)}
    imported = {alias.asname for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname}
    assert set(module.__all__) == set(functions) | classes | imported
    for name, node in functions.items():
        compare(parameters(node.args, False), real_parameters(getattr(module, name), name, False), name)
        assert "\n" in getattr(module, name).__doc__


def test_python_parts_have_annotations():
    """builder.py and history.py need no stubs: everything public in them is annotated and documented."""
    for cls in (abut.ModelBuilder, abut.History):
        for name, member in vars(cls).items():
            function = member.__func__ if isinstance(member, staticmethod) else member
            if name.startswith("_") or not inspect.isfunction(function):
                continue
            signature = inspect.signature(function)
            assert function.__doc__, f"{cls.__name__}.{name}"
            assert signature.return_annotation is not inspect.Signature.empty, f"{cls.__name__}.{name}"
            assert all(p.annotation is not inspect.Parameter.empty for n, p in signature.parameters.items() if n != "self"), name
    assert (PACKAGE / "py.typed").is_file()


def test_without_its_compiled_half_it_says_what_makes_it(tmp_path):
    shutil.copytree(PACKAGE, tmp_path / "abut", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    done = subprocess.run([sys.executable, "-c", "import abut"], cwd=tmp_path, env={"PYTHONPATH": str(tmp_path)}, text=True, stderr=subprocess.PIPE)
    assert done.returncode == 1
    assert "ImportError: abut's compiled half, abut._native, is not built for this Python" in done.stderr
