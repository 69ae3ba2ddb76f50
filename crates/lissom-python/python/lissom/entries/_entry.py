"""What all entries of a model share: how they are written as TOML, and read from it."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, fields
from typing import Any, ClassVar, Union

from .. import _toml
from .._tables import known

#: A number, or an expression.
Number = Union[float, str]
#: A whole number, or an expression.
Count = Union[int, str]
#: Numbers or expressions.
Vector = Sequence[Number]
#: The name of a point or node, or three numbers.
Place = Union[str, Vector]
#: Keys and values.
Table = Mapping[str, Any]
#: Tables by name.
Tables = Mapping[str, Any]
#: Texts.
Names = Sequence[str]
#: A number, an expression, or a table `{"table": [[t, value], …]}`.
Function = Union[float, str, Table]

#: Tables without named entries.
SINGLE = ("analysis", "ground", "initial")


class Entry:
    """An entry of a model. `str` gives the TOML it means."""

    __slots__ = ()
    #: The table it stands in.
    _table: ClassVar[str] = ""
    #: The key whose word chooses the class, and that word.
    _tag: ClassVar[str] = ""
    _form: ClassVar[str] = ""

    def to_table(self) -> dict[str, Any]:
        """Keys and values as the model file has them; what was not given is left out."""
        table: dict[str, Any] = {self._tag: self._form} if self._tag else {}
        for field in fields(self):  # type: ignore[arg-type]
            of = getattr(self, field.name)
            if of is None:
                continue
            if field.name == "motions" and self._table == "initial":
                table.update(of)
            else:
                table[field.name.rstrip("_")] = of
        return table

    @classmethod
    def _of(cls, table: Mapping[str, Any]) -> Entry:
        """From keys and values of a model file."""
        own = {field.name.rstrip("_"): field.name for field in fields(cls)}  # type: ignore[arg-type]
        values: dict[str, Any] = {}
        for key, of in table.items():
            if key == cls._tag:
                continue
            if key in own:
                values[own[key]] = of
            elif cls._table == "initial":
                from .motions import PartMotion

                values.setdefault("motions", {})[key] = PartMotion._of(of)
            else:
                known(key, own, f"key of {cls.__name__}")
        return cls(**values)

    def __str__(self) -> str:
        return "\n".join(lines(self.to_table()))


def lines(table: Mapping[str, Any]) -> list[str]:
    """A line per key."""
    return [f"{_toml.key(key)} = {_toml.value(of)}" for key, of in table.items()]


class Entries(dict[str, Any]):
    """Entries of a table by name. `KeyError` suggests a similar name."""

    def __missing__(self, name: str) -> Any:
        return known(name, self, "entry")


class ModelTree:
    """The tables of a model that is built, or of one that was read, once they are asked for."""

    __slots__ = ("_tables",)

    #: Values and tables by the words at the top of a model file; none as long as nobody has asked for them.
    _tables: dict[str, Any] | None

    def _source(self) -> str:
        """The TOML of a model that was read."""
        raise NotImplementedError

    def _opened(self) -> dict[str, Any]:
        if self._tables is None:
            self._tables = read(self._source())
        return self._tables

    def _table(self, name: str) -> Any:
        return self._opened().setdefault(name, Entries())

    def _value(self, name: str) -> Any:
        return self._opened().get(name)

    def _set(self, name: str, of: Any) -> None:
        if of is None:
            self._opened().pop(name, None)
        else:
            self._opened()[name] = of


def read(text: str) -> dict[str, Any]:
    """The tables of a model file, their entries as objects."""
    from ._model_tables import CLASSES

    tables: dict[str, Any] = {}
    for name, of in _toml.parse(text).items():
        classes = CLASSES.get(name)
        if classes is None:
            tables[name] = Entries(of) if isinstance(of, dict) else of
        elif name in SINGLE:
            tables[name] = entry(classes, of)
        else:
            tables[name] = Entries({key: entry(classes, inner) for key, inner in of.items()})
    tables.pop("lissom", None)
    return tables


def entry(classes: type[Entry] | dict[str, type[Entry]], table: Mapping[str, Any]) -> Entry:
    """The object that a table means."""
    if not isinstance(classes, dict):
        return classes._of(table)
    tag = next(iter(classes.values()))._tag
    return classes[table[tag]]._of(table)


def written(tables: Mapping[str, Any]) -> str:
    """The model file."""
    from ._model_tables import CLASSES, ORDER

    unknown = [name for name in tables if name not in ORDER]
    if unknown:
        near = difflib.get_close_matches(unknown[0], ORDER, n=1)
        raise TypeError(f"a model has no `{unknown[0]}`" + (f"; did you mean `{near[0]}`?" if near else ""))
    top = ["lissom = 1"]
    blocks: list[list[str]] = []
    for name in (name for name in ORDER if tables.get(name) is not None):
        of, classes = tables[name], CLASSES.get(name)
        if classes is None and not isinstance(of, Mapping):
            top.append(f"{name} = {_toml.value(of)}")
        elif classes is None:
            if of:
                blocks.append([f"[{name}]", *lines(of)])
        elif name in SINGLE:
            blocks.append([f"[{name}]", *lines(checked(name, name, of))])
        else:
            blocks += [[f"[{name}.{_toml.key(str(key))}]", *lines(checked(name, key, of[key]))] for key in of]
    return "\n\n".join("\n".join(block) for block in [top, *blocks]) + "\n"


def checked(name: str, key: str, of: Any) -> Mapping[str, Any]:
    """Keys and values of an entry, which must belong to the table it stands in; a dictionary is taken as it is."""
    if isinstance(of, Mapping):
        return of
    if not isinstance(of, Entry) or of._table != name:
        where = f"`{name}`" if name == key else f"`{name}.{key}`"
        raise TypeError(f"{where} is {type(of).__name__}, which is no entry of the table `{name}`")
    return of.to_table()


def required(of: type[Entry]) -> list[str]:
    """Keys that must be given."""
    own = fields(of)  # type: ignore[arg-type]
    return [field.name.rstrip("_") for field in own if field.default is MISSING and field.default_factory is MISSING]
