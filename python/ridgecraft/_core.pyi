# SPDX-License-Identifier: GPL-3.0-or-later
from typing import Any, Callable, Dict, List, Optional, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

__version__: str

class Error(Exception): ...
class UsageError(Error, ValueError): ...
class UnreadableInput(Error, OSError): ...
class UnusableMesh(Error, ValueError): ...
class NoNets(Error): ...
class Unbuildable(Error): ...
class OutOfTime(Error, TimeoutError): ...

class Nets:
    @property
    def vertices(self) -> npt.NDArray[np.float64]: ...
    @property
    def faces(self) -> npt.NDArray[np.int32]: ...
    @property
    def polygons(self) -> npt.NDArray[np.int32]: ...
    @property
    def part(self) -> npt.NDArray[np.int32]: ...
    @property
    def piece(self) -> npt.NDArray[np.int32]: ...
    @property
    def flat(self) -> npt.NDArray[np.float64]: ...
    @property
    def edges(self) -> npt.NDArray[np.int32]: ...
    @property
    def edge_uses(self) -> List[str]: ...
    @property
    def fold_angles(self) -> npt.NDArray[np.float64]: ...
    @property
    def piece_names(self) -> List[str]: ...
    @property
    def joins(self) -> List[Tuple[int, int, int]]: ...
    @property
    def tabs(self) -> List[Tuple[int, npt.NDArray[np.float64]]]: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def figures(self) -> Dict[str, float]: ...
    @property
    def fold(self) -> str: ...

class Paper(Nets):
    @property
    def page_count(self) -> int: ...
    def pdf(self) -> bytes: ...
    def svg(self, page: int) -> str: ...
    def png(self, page: int, dots_per_inch: float = 150.0) -> bytes: ...
    def dxf(self, page: int) -> str: ...

def read(file: str) -> Tuple[npt.NDArray[np.float64], Any]: ...
def segment(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    concavity: float,
    effort: int,
    parts: Optional[int],
    volume_weight: Optional[float],
    planes: bool,
    pockets: bool,
    holes: str,
    components: str,
    threads: int,
    seed: int,
    progress: Optional[Callable[[str, float], Any]],
) -> npt.NDArray[np.int32]: ...
def hulls(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    concavity: float,
    effort: int,
    parts: Optional[int],
    most_parts: Optional[int],
    max_vertices: int,
    volume_weight: Optional[float],
    planes: bool,
    pockets: bool,
    holes: str,
    components: str,
    threads: int,
    seed: int,
    progress: Optional[Callable[[str, float], Any]],
) -> List[Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]]: ...
@overload
def make(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    size: Optional[float],
    scale: Optional[float],
    sheet: None,
    margin: float,
    simplify: Union[int, str],
    concavity: float,
    whole: bool,
    pieces: str,
    tabs: bool,
    tab_height: float,
    all_tabs: bool,
    unite: bool,
    fold_linear: bool,
    strict: bool,
    title: str,
    threads: int,
    seed: int,
    time_limit: Optional[float],
    progress: Optional[Callable[[str, float], Any]],
) -> Nets: ...
@overload
def make(
    vertices: npt.ArrayLike,
    faces: Any,
    *,
    size: Optional[float],
    scale: Optional[float],
    sheet: str,
    margin: float,
    simplify: Union[int, str],
    concavity: float,
    whole: bool,
    pieces: str,
    tabs: bool,
    tab_height: float,
    all_tabs: bool,
    unite: bool,
    fold_linear: bool,
    strict: bool,
    title: str,
    threads: int,
    seed: int,
    time_limit: Optional[float],
    progress: Optional[Callable[[str, float], Any]],
) -> Paper: ...
