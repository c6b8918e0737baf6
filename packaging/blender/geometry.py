"""What a depsgraph has, as nodes of glTF, and its meshes as objects for Blender's exporter.

The depsgraph is what Cycles reads: modifiers, shape keys, bones, constraints, instances and what is
hidden or excluded are evaluated in it.
"""

from contextlib import contextmanager

import bpy
import numpy as np
from mathutils import Matrix

from .nodes import of_surface, output_of, tree_of
from .surfaces import has_lost_tiles

# From z up to y up
UPRIGHT = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def rendered(depsgraph):
    """The instances of objects that are rendered: each is valid until the next."""
    return (each for each in depsgraph.object_instances if each.show_self)


def slots(owner, override=None):
    """The materials of an object, by slot."""
    return [override or slot.material for slot in owner.material_slots]


def numbers(matrix):
    """As glTF has them."""
    return [c for column in matrix.col for c in column]


class Meshes:
    """Those that are rendered, each once.

    :ivar scene: of an object for each
    :ivar names: by the names of their copies
    :ivar materials: as they are evaluated, by the names of those that the meshes have
    :ivar places: the object's name, the instance's name and its matrix in glTF
    """

    def __init__(self, depsgraph, override):
        self.scene = bpy.data.scenes.new("Candela")
        self.names, self.places, self._objects = {}, [], {}
        self.materials, self._copies = {}, {}
        self._depsgraph, self._override = depsgraph, override

    def collect(self):
        for instance in rendered(self._depsgraph):
            # Evaluated curves, texts and metaballs are meshes here, too
            if instance.object.type == "MESH":
                name = self._object(instance)
                matrix = UPRIGHT @ instance.matrix_world @ UPRIGHT.inverted()
                self.places.append((name, instance.object.name, numbers(matrix)))

    def _object(self, instance):
        source = instance.object
        materials = slots(source, self._override) or [self._override]
        key = (source.data.as_pointer(), *(m and m.as_pointer() for m in materials))
        if key not in self._objects:
            mesh = self._copy(source, instance.instance_object or source)
            for k, material in enumerate(materials):
                material = material and self._material(material)
                if k < len(mesh.materials):
                    mesh.materials[k] = material
                else:
                    mesh.materials.append(material)
            _drop_maps(mesh, materials)
            self.names[mesh.name] = source.data.name
            made = bpy.data.objects.new("Candela", mesh)
            self.scene.collection.objects.link(made)
            self._objects[key] = made.name
        return self._objects[key]

    def _copy(self, source, instanced):
        if source.data != instanced.data:
            # A geometry of nodes, or the surface of a curve
            return source.data.copy()
        return bpy.data.meshes.new_from_object(instanced)

    def _material(self, evaluated):
        """The original, or a copy with the values of this time, as the exporter needs it."""
        original = evaluated.original
        tree = tree_of(original)
        if tree is not None and (tree.animation_data is not None or _is_misread(tree)):
            if original.name not in self._copies:
                self._copies[original.name] = _still(original, evaluated)
            original = self._copies[original.name]
        self.materials[original.name] = evaluated
        return original

    def remove(self):
        objects = list(self.scene.objects)
        data = [each.data for each in objects]
        bpy.data.batch_remove([*objects, *data, *self._copies.values(), self.scene])


def _is_misread(tree):
    """Whether the exporter reads another output than Cycles, or fails to read tiles."""
    output = output_of(tree)
    is_other = output is not None and not output.is_active_output
    return is_other or any(has_lost_tiles(node) for node in tree.nodes)


def _still(original, evaluated):
    """A copy of a material with the evaluated values of its nodes."""
    made = original.copy()
    made.node_tree.animation_data_clear()
    output = output_of(made.node_tree)
    if output is not None:
        output.is_active_output = True
    for node, source in zip(made.node_tree.nodes, evaluated.node_tree.nodes, strict=True):
        sockets = zip((*node.inputs, *node.outputs), (*source.inputs, *source.outputs), strict=True)
        for socket, animated in sockets:
            if hasattr(socket, "default_value"):
                socket.default_value = animated.default_value
    for node in filter(has_lost_tiles, list(made.node_tree.nodes)):
        made.node_tree.nodes.remove(node)
    return made


def open_slots(mesh):
    """The slots of the materials of faces with an edge that no other face has."""
    edges = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("edge_index", edges)
    is_open = np.bincount(edges, minlength=len(mesh.edges))[edges] == 1
    sizes, slots = (np.empty(len(mesh.polygons), np.int32) for _ in range(2))
    mesh.polygons.foreach_get("loop_total", sizes)
    mesh.polygons.foreach_get("material_index", slots)
    return set(np.repeat(slots, sizes)[is_open].tolist())


def _drop_maps(mesh, materials):
    """Leaves the UV maps that the materials name, and that of images that name none."""
    used = {each.name for each in mesh.uv_layers if each.active_render}
    for material in materials:
        for node in of_surface(material) if material is not None else ():
            used |= {getattr(node, "uv_map", ""), getattr(node, "attribute_name", "")}
    for name in [each.name for each in mesh.uv_layers if each.name not in used]:
        mesh.uv_layers.remove(mesh.uv_layers[name])


@contextmanager
def meshes(depsgraph, override=None):
    """The meshes that are rendered, for the time of the export.

    :param override: a material instead of all
    """
    # The exporter shows the scene that it exports
    shown = [(w, w.scene, w.view_layer) for w in bpy.context.window_manager.windows]
    made = Meshes(depsgraph, override)
    try:
        made.collect()
        yield made
    finally:
        for window, scene, view_layer in shown:
            if window.scene != scene:
                window.scene, window.view_layer = scene, view_layer
        made.remove()
