"""Volume objects, as nodes with `extras.candela.medium`: docs/MODELS.md."""

import importlib
import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

from . import media, nanovdb
from .geometry import UPRIGHT, numbers, rendered


def nodes(depsgraph, override, folder: Path, warn):
    """Name, matrix and medium of each volume that is rendered; its grid is a file in the folder."""
    found, written = [], {}
    for instance in rendered(depsgraph):
        each = instance.object
        if each.type != "VOLUME":
            continue
        data, name = each.data, each.original.name
        materials = [override] if override else _materials(each)
        material = next((m for m in materials if m is not None), None)
        key = (data.as_pointer(), material)
        if key not in written:
            file = folder / f"volume-{len(written) + 1}.nvdb"
            written[key] = _medium(data, material, file, lambda text, n=name: _warn(n, text, warn))
        if written[key] is not None:
            medium, place, to_object = written[key]
            columns = numbers(UPRIGHT @ instance.matrix_world @ to_object)
            scale = _density(data, instance.matrix_world)
            found.append((name, columns, {**medium.fields(scale), **place}))
    return found


def _density(data, matrix):
    """Scale of the coefficients, as Cycles has it: what is scaled is as opaque as before."""
    diagonal = (matrix.to_3x3() @ Vector((1, 1, 1))).length / math.sqrt(3)
    return 1 / diagonal if data.render.space == "OBJECT" and diagonal > 0 else 1.0


def _warn(name, text, warn):
    warn(f"volume '{name}': {text}")


def _materials(each):
    slots = [slot.material for slot in each.material_slots]
    return slots or list(each.data.materials)


def _medium(data, material, file: Path, warn):
    """The medium, the members of its grid, which is written to the file, and the map from there."""
    openvdb = _openvdb()
    if openvdb is None:
        warn("this Blender has no module openvdb to read it; left out")
        return None
    if not data.grids.load():
        warn(f"{data.grids.error_message or 'it has no grids'}; left out")
        return None
    names = [grid.name for grid in data.grids]
    medium = media.DEFAULT if material is None else media.of(material, names, warn)
    if medium is not None and any(medium.emission):
        warn("its emission is not supported; left out")
    if medium is None or medium.is_empty:
        return None
    if medium.grid not in names:
        has = "', '".join(names)
        warn(f"its material has no density by one of its grids, '{has}'; left out")
        return None
    path = file.with_suffix(".vdb")
    try:
        if not data.grids.save(str(path)):
            warn(f"{data.grids.error_message}; left out")
            return None
        grid = openvdb.read(str(path), medium.grid)
        if grid.valueTypeName not in ("float", "double"):
            raise nanovdb.NoVolume(f"it has values of type {grid.valueTypeName}")
        low, high, to_object = nanovdb.write(file, medium.grid, grid)
    except nanovdb.NoVolume as cause:
        warn(f"grid '{medium.grid}' is left out: {cause}")
        return None
    finally:
        path.unlink(missing_ok=True)
    place = {"uri": file.name, "grid": medium.grid, "box": low + high}
    return medium, place, Matrix(to_object.tolist())


def _openvdb():
    """Blender's module, or None. PyPI's bpy has it where Python doesn't look."""
    for _ in range(2):
        for name in ("openvdb", "pyopenvdb"):
            try:
                return importlib.import_module(name)
            except ImportError:
                pass
        root = Path(bpy.utils.resource_path("LOCAL")) / "python" / "lib"
        sys.path += [str(folder) for folder in root.glob("**/site-packages")]
    return None
