from collections.abc import Sequence
from decimal import Decimal

__version__: str

_Numbers = tuple[str, Sequence[int], bytearray]
_Cell = str | float | Sequence[float] | Decimal | Sequence[Decimal] | int | bool | dict[str, str] | None
_Table = tuple[int, list[tuple[str, _Numbers | list[_Cell]]]]

def ask(
    arguments: Sequence[str], input: tuple[str, str] | None
) -> tuple[list[_Table], str | None, str | None, int, list[str]]: ...
def next_impact(
    is_top: bytes,
    phases: bytes,
    velocities: bytes,
    parameters: Sequence[float],
    with_jacobian: bool,
) -> tuple[list[str | None], list[_Numbers], list[tuple[int, str]]]: ...
