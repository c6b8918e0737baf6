"""Walks through node trees."""


import bpy

# From Blender 5.0 on, materials and worlds always have nodes
_ALWAYS_USED = bpy.app.version >= (5, 0, 0)


def tree_of(owner):
    """The nodes of a material or a world, or None."""
    return owner.node_tree if _ALWAYS_USED or owner.use_nodes else None


def output_of(tree, kind):
    """The active output of this type, or None."""
    outputs = [node for node in tree.nodes if node.type == kind]
    active = [node for node in outputs if getattr(node, "is_active_output", True)]
    return (active or outputs or [None])[0]


def linked(node, name):
    """The node whose output is linked to the input of that name, or None."""
    return source(node.inputs[name]) if name in node.inputs else None


def source(socket):
    """The node that a socket is linked to, through reroutes, or None."""
    while socket.is_linked:
        link = socket.links[0]
        if link.is_muted:
            return None
        if link.from_node.type != "REROUTE":
            return link.from_node
        socket = link.from_node.inputs[0]
    return None


def unlinked(socket):
    """The value of a socket, if it is constant: a number, or a tuple."""
    node = source(socket)
    if node is None:
        value = socket.default_value
    elif node.type in ("RGB", "VALUE"):
        value = node.outputs[0].default_value
    else:
        return None
    return value if isinstance(value, (int, float)) else tuple(value)


def upstream(node):
    """A node and all that it depends on, each once, also within groups."""
    seen, waiting = set(), [node]
    while waiting:
        each = waiting.pop()
        if each is None or each in seen:
            continue
        seen.add(each)
        yield each
        waiting += [source(socket) for socket in each.inputs if socket.enabled]
        if each.type == "GROUP" and each.node_tree is not None:
            waiting.append(output_of(each.node_tree, "GROUP_OUTPUT"))
