"""Writes sparse grids of OpenVDB as NanoVDB 32.3, uncompressed.

Source: the layout documented in NanoVDB's `NanoVDB.h` and `util/IO.h`, openvdb.org.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

VERSION = 32 << 21 | 3 << 10 | 3
MAGIC = b"NanoVDB0"
_FLOAT, _FOG_VOLUME, _FILE_VALUES = 1, 2, 0
_HAS_BOX_AND_RANGE = 6

# Voxels along an axis: nodes of the root, of these, and leaves
_UPPER, _LOWER, _LEAF = 4096, 128, 8
_LOWERS, _LEAVES, _VOXELS = 32, 16, 8

# Depths of OpenVDB's accessors
_BACKGROUND, _ROOT_TILE, _UPPER_TILE = -1, 0, 1

_GRID = np.dtype([
    ("magic", "S8"), ("checksum", "<i8"), ("version", "<u4"), ("flags", "<u4"), ("index", "<i4"),
    ("count", "<u4"), ("size", "<u8"), ("name", "S256"), ("matrix", "<f4", 9),
    ("inverse", "<f4", 9), ("shift", "<f4", 3), ("taper", "<f4"), ("matrix_d", "<f8", 9),
    ("inverse_d", "<f8", 9), ("shift_d", "<f8", 3), ("taper_d", "<f8"), ("box", "<f8", 6),
    ("voxel", "<f8", 3), ("class", "<u4"), ("type", "<u4"), ("padding", "V32"),
    # The tree: offsets and counts of leaves, lower and upper nodes, the root's offset
    ("offsets", "<u8", 4), ("counts", "<u4", 3), ("tiles", "<u4", 3), ("voxels", "<u8"),
])  # fmt: skip
_STATISTICS = [("min", "<f4"), ("max", "<f4"), ("mean", "<f4"), ("deviation", "<f4")]
_ROOT = np.dtype([
    ("low", "<i4", 3), ("high", "<i4", 3), ("tiles", "<u4"), ("background", "<f4"), *_STATISTICS,
    ("padding", "V16"),
])  # fmt: skip
_TILE = np.dtype([
    ("key", "<u8"), ("child", "<i8"), ("state", "<u4"), ("value", "<f4"), ("padding", "V8"),
])  # fmt: skip


def _node(slots, padding):
    return np.dtype([
        ("low", "<i4", 3), ("high", "<i4", 3), ("flags", "<u8"), ("active", "u1", slots // 8),
        ("children", "u1", slots // 8), *_STATISTICS, ("padding", f"V{padding}"),
        ("table", "<i8", slots),
    ])  # fmt: skip


_UPPER_NODE, _LOWER_NODE = _node(_LOWERS**3, 16), _node(_LEAVES**3, 16)
_LEAF_NODE = np.dtype([
    ("low", "<i4", 3), ("span", "u1", 3), ("flags", "u1"), ("active", "u1", _VOXELS**3 // 8),
    *_STATISTICS, ("values", "<f4", _VOXELS**3),
])  # fmt: skip
_META = np.dtype([
    ("size", "<u8"), ("stored", "<u8"), ("key", "<u8"), ("voxels", "<u8"), ("type", "<u4"),
    ("class", "<u4"), ("box", "<f8", 6), ("low", "<i4", 3), ("high", "<i4", 3), ("voxel", "<f8", 3),
    ("name_size", "<u4"), ("nodes", "<u4", 4), ("tiles", "<u4", 3), ("codec", "<u2"),
    ("padding", "<u2"), ("version", "<u4"),
])  # fmt: skip
_HEADER = np.dtype([("magic", "S8"), ("version", "<u4"), ("grids", "<u2"), ("codec", "<u2")])


class NoVolume(Exception):
    """The grid has no voxels, or can't be a density: the cause."""


class _Lower(NamedTuple):
    """A node of 16³ leaves or values."""

    corner: tuple
    values: np.ndarray
    is_leaf: np.ndarray
    leaves: np.ndarray  # the voxels of each leaf


class _Upper(NamedTuple):
    """A node of 32³ lower nodes or values, or one value."""

    corner: tuple
    lowers: list
    values: np.ndarray  # empty if it has children


def write(path, name, grid):
    """Writes a grid of OpenVDB to a file of its own.

    Its voxels are along the file's axes, as pbrt expects them.

    :return: lowest and highest corner in the file's space, and its map to the grid's, 4 × 4
    """
    tree = _Tree(grid)
    to_grid = _index_to_space(grid.transform)
    size = np.linalg.norm(to_grid[:3, :3], axis=0)
    if not np.isfinite(to_grid).all() or abs(np.linalg.det(to_grid)) == 0:
        raise NoVolume("its voxels have no volume")
    to_grid[:3, :3] /= size
    # Between voxels values are interpolated, also with the empty ones around
    low, high = tree.low - 1, tree.high
    box = np.concatenate([low * size, (high + 1) * size])
    body = _body(name, tree, size, low, high, box)
    length = sum(part.nbytes for part in body)
    body[0]["size"] = length
    grid_header = body[0][0]
    text = name.encode()[:255] + b"\0"
    meta = np.zeros(1, _META)
    for field in ("type", "class", "voxels", "box", "voxel"):
        meta[field] = grid_header[field]
    meta["size"] = meta["stored"] = length
    meta["key"], meta["low"], meta["high"] = _hash(text[:-1]), low, high
    meta["name_size"], meta["version"] = len(text), VERSION
    meta["nodes"] = [*grid_header["counts"], 1]
    header = np.zeros(1, _HEADER)
    header["magic"], header["version"], header["grids"] = MAGIC, VERSION, 1
    with open(path, "wb") as file:
        file.write(header.tobytes() + meta.tobytes() + text)
        for part in body:
            file.write(part.tobytes())
    return box[:3].tolist(), box[3:].tolist(), to_grid


def _hash(name):
    key = 0
    for character in name:
        key = (key * 67 + character + (key >> 56)) % 2**64
    return key


def _index_to_space(transform):
    if not transform.isLinear:
        raise NoVolume("its voxels are no boxes")
    origin = np.array(transform.indexToWorld((0, 0, 0)))
    axes = [np.array(transform.indexToWorld(tuple(unit))) - origin for unit in np.eye(3).tolist()]
    return np.vstack([np.column_stack([*axes, origin]), [0, 0, 0, 1]])


class _Tree:
    """The nodes of a grid, and the box of the voxels that aren't empty."""

    def __init__(self, grid):
        if grid.background != 0:
            raise NoVolume(f"it is {grid.background:g} outside its voxels, not 0")
        self._grid, self._accessor = grid, grid.getConstAccessor()
        self.low, self.high = np.full(3, 2**31 - 1, np.int64), np.full(3, -(2**31), np.int64)
        self.uppers = []
        bounds = grid.evalActiveVoxelBoundingBox()
        if not grid.empty() and all(a <= b for a, b in zip(*bounds, strict=True)):
            for corner in _corners(bounds, _UPPER):
                self._add(corner, bounds)
        if not self.uppers:
            raise NoVolume("it is empty")
        self.uppers.sort(key=lambda upper: _key(upper.corner))

    def _add(self, corner, bounds):
        depth = self._accessor.getValueDepth(corner)
        if depth == _BACKGROUND:
            return
        if depth == _ROOT_TILE:
            value = self._value(corner)
            if value != 0:
                self._include(corner, (0, 0, 0), (_UPPER - 1,) * 3)
                self.uppers.append(_Upper(corner, [], np.array([value], np.float32)))
            return
        inside = [
            (max(a, c), min(b, c + _UPPER - 1)) for a, b, c in zip(*bounds, corner, strict=True)
        ]
        places = _corners(tuple(zip(*inside, strict=True)), _LOWER)
        lowers = [lower for lower in map(self._lower, places) if lower is not None]
        if lowers:
            self.uppers.append(_Upper(corner, lowers, np.empty(0)))

    def _lower(self, corner):
        if self._accessor.getValueDepth(corner) <= _UPPER_TILE:
            block = np.full((1,) * 3, self._value(corner), np.float32)
            block = np.broadcast_to(block, (_LOWER,) * 3)
        else:
            block = np.empty((_LOWER,) * 3, np.float32)
            self._grid.copyToArray(block, corner)
            block[~np.isfinite(block)] = 0
        filled = block != 0
        if not filled.any():
            return None
        spans = [np.flatnonzero(filled.any(axis)) for axis in ((1, 2), (0, 2), (0, 1))]
        self._include(corner, [s[0] for s in spans], [s[-1] for s in spans])
        split = block.reshape(_LEAVES, _VOXELS, _LEAVES, _VOXELS, _LEAVES, _VOXELS)
        leaves = split.transpose(0, 2, 4, 1, 3, 5).reshape(_LEAVES**3, _VOXELS**3)
        is_leaf = (leaves != leaves[:, :1]).any(1)
        return _Lower(corner, np.where(is_leaf, 0, leaves[:, 0]), is_leaf, leaves[is_leaf])

    def _value(self, corner):
        value = self._accessor.getValue(corner)
        return value if np.isfinite(value) else 0.0

    def _include(self, corner, low, high):
        self.low = np.minimum(self.low, np.add(corner, low))
        self.high = np.maximum(self.high, np.add(corner, high))


def _corners(bounds, width):
    """Corners of the blocks of a width that the bounds touch."""
    ranges = [range(a // width * width, b + 1, width) for a, b in zip(*bounds, strict=True)]
    return product(*ranges)


def _key(corner):
    x, y, z = ((c % 2**32) >> 12 for c in corner)
    return z | y << 21 | x << 42


def _bits(flags):
    return np.packbits(flags, axis=-1, bitorder="little")


def _body(name, tree, size, low, high, box):
    """Header, root, tiles, upper nodes, lower nodes and leaves."""
    lowers = [lower for upper in tree.uppers for lower in upper.lowers]
    grid, root = np.zeros(1, _GRID), np.zeros(1, _ROOT)
    tiles = np.zeros(len(tree.uppers), _TILE)
    uppers = np.zeros(sum(len(upper.values) == 0 for upper in tree.uppers), _UPPER_NODE)
    middle = np.zeros(len(lowers), _LOWER_NODE)
    leaves = np.zeros(sum(len(lower.leaves) for lower in lowers), _LEAF_NODE)
    begins = np.cumsum([p.nbytes for p in (grid, root, tiles, uppers, middle)])
    after_grid, _, first_upper, first_lower, first_leaf = begins.tolist()

    _fill_leaves(leaves, lowers)
    _fill_lowers(middle, lowers, first_lower, first_leaf)
    values = np.concatenate([
        leaves["values"].ravel(), *[lower.values[~lower.is_leaf] for lower in lowers],
        *[upper.values for upper in tree.uppers],
    ])  # fmt: skip
    for part in (root, uppers):
        part["min"], part["max"] = values.min(initial=0), values.max(initial=0)
        part["low"], part["high"] = low, high
    lower, upper = 0, 0
    for tile, node in zip(tiles, tree.uppers, strict=True):
        tile["key"] = _key(node.corner)
        if len(node.values) > 0:
            tile["state"], tile["value"] = 1, node.values[0]
            continue
        at = first_upper + upper * _UPPER_NODE.itemsize
        tile["child"] = at - after_grid
        has_child = np.zeros(_LOWERS**3, bool)
        for child in node.lowers:
            x, y, z = ((c - d) // _LOWER for c, d in zip(child.corner, node.corner, strict=True))
            slot = (x * _LOWERS + y) * _LOWERS + z
            has_child[slot] = True
            uppers[upper]["table"][slot] = first_lower + lower * _LOWER_NODE.itemsize - at
            lower += 1
        uppers[upper]["children"] = _bits(has_child)
        upper += 1

    root["tiles"] = len(tiles)
    grid["magic"], grid["checksum"], grid["version"] = MAGIC, -1, VERSION
    grid["flags"], grid["count"], grid["name"] = _HAS_BOX_AND_RANGE, 1, name.encode()[:255]
    grid["matrix"] = grid["matrix_d"] = np.diag(size).ravel()
    grid["inverse"] = grid["inverse_d"] = np.diag(1 / size).ravel()
    grid["taper"] = grid["taper_d"] = 1
    grid["box"], grid["voxel"] = box, size
    grid["class"], grid["type"] = _FOG_VOLUME, _FLOAT
    places = np.array([first_leaf, first_lower, first_upper, after_grid])
    grid["offsets"] = places - _GRID.fields["offsets"][1]
    grid["counts"] = [len(leaves), len(middle), len(uppers)]
    grid["voxels"] = np.count_nonzero(leaves["values"])
    return [grid, root, tiles, uppers, middle, leaves]


def _fill_leaves(leaves, lowers):
    start = 0
    for lower in lowers:
        some = leaves[start : start + len(lower.leaves)]
        places = np.stack(np.unravel_index(np.flatnonzero(lower.is_leaf), (_LEAVES,) * 3), -1)
        some["low"] = np.array(lower.corner) + _LEAF * places
        some["values"] = lower.leaves
        start += len(some)
    leaves["span"], leaves["flags"] = _VOXELS - 1, 2
    leaves["active"] = _bits(leaves["values"] != 0)
    leaves["min"], leaves["max"] = leaves["values"].min(1), leaves["values"].max(1)


def _fill_lowers(nodes, lowers, first_lower, first_leaf):
    leaf = first_leaf
    for i, (node, lower) in enumerate(zip(nodes, lowers, strict=True)):
        at = first_lower + i * _LOWER_NODE.itemsize
        node["low"], node["high"] = lower.corner, np.add(lower.corner, _LOWER - 1)
        node["children"], node["active"] = _bits(lower.is_leaf), _bits(lower.values != 0)
        # Values have the first four bytes of an entry
        table = np.zeros((_LEAVES**3, 2), "<f4")
        table[:, 0] = lower.values
        entries = table.view("<i8")[:, 0]
        count = len(lower.leaves)
        entries[lower.is_leaf] = leaf - at + _LEAF_NODE.itemsize * np.arange(count)
        node["table"] = entries
        every = np.concatenate([lower.leaves.ravel(), lower.values])
        node["min"], node["max"] = every.min(), every.max()
        leaf += count * _LEAF_NODE.itemsize
