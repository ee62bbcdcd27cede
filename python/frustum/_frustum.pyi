import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

File = Union[str, os.PathLike[str]]
ErrorSource = Union[File, dict[str, str]]
Errors = Union[None, ErrorSource, list[ErrorSource], tuple[ErrorSource, ...]]

__version__: str

class InputError(ValueError):
    diagnostics: list[dict[str, Any]]

class Machine:
    def __init__(self, name: File) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def structure(self) -> str: ...
    @property
    def axes(self) -> list[str]: ...
    @property
    def travels(self) -> NDArray[np.float64]: ...
    def pose(
        self,
        axes: ArrayLike,
        errors: Errors = None,
        tool_length: float = 0.0,
        approach: Optional[ArrayLike] = None,
        draw: Optional[int] = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def inverse(
        self, tip: ArrayLike, direction: ArrayLike, tool_length: float = 0.0, previous: Optional[ArrayLike] = None
    ) -> NDArray[np.float64]: ...

class Population:
    def __init__(self, file: File, seed: Optional[int] = None, errors: Errors = None) -> None: ...
    @property
    def characteristics(self) -> list[str]: ...
    @property
    def units(self) -> list[str]: ...
    def evaluate(
        self, count: int, first: int = 0, engine: str = "full"
    ) -> tuple[NDArray[np.float64], dict[int, str]]: ...
    def amounts(self, count: int, first: int = 0) -> dict[str, NDArray[np.float64]]: ...

class Workpiece:
    def along(
        self, origins: ArrayLike, directions: ArrayLike, start: float = 0.0, end: float = 1e4
    ) -> tuple[NDArray[np.int64], NDArray[np.float64]]: ...
    def first(
        self, origins: ArrayLike, directions: ArrayLike, start: float = 0.0, end: float = 1e4
    ) -> dict[str, NDArray[Any]]: ...

def machines() -> list[str]: ...
def fit(
    element: str,
    points: ArrayLike,
    *,
    criterion: str = "ls",
    axis: Optional[ArrayLike] = None,
    radius: Optional[float] = None,
    half_angle: Optional[float] = None,
    weights: Optional[ArrayLike] = None,
    outward: Optional[ArrayLike] = None,
    hole: bool = False,
) -> dict[str, Any]: ...
