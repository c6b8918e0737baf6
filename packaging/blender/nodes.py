"""Walks through node trees."""


import bpy

# From Blender 5.0 on, materials and worlds always have nodes
_ALWAYS_USED = bpy.app.version >= (5, 0, 0)


def tree_of(owner):
    """The nodes of a material or a world, or None."""
    return owner.node_tree if _ALWAYS_USED or owner.use_nodes else None


def output_of(tree):
    """The output that Cycles reads of a material, a world or a light, or None."""
    return tree.get_output_node("CYCLES")


def linked(node, name):
    """The node whose output is linked to the input of that name, or None."""
    return source(node.inputs[name]) if name in node.inputs else None


def source(socket):
    """The node that a socket is linked to, through reroutes and muted nodes, or None."""
    return _origin(socket)[1]


def unlinked(socket):
    """The value of a socket, if it is constant: a number, or a tuple."""
    end, node = _origin(socket)
    if node is None:
        value = end.default_value
    elif node.type in ("RGB", "VALUE"):
        value = node.outputs[0].default_value
    else:
        return None
    return value if isinstance(value, (int, float)) else tuple(value)


def _origin(socket):
    """The last socket on the way to the node that one is linked to, and that node or None."""
    while socket.is_linked:
        link = socket.links[0]
        node = link.from_node
        if link.is_muted:
            break
        if node.type == "REROUTE":
            socket = node.inputs[0]
        elif node.mute:
            passed = [x.from_socket for x in node.internal_links if x.to_socket == link.from_socket]
            if not passed:
                break
            socket = passed[0]
        else:
            return socket, node
    return socket, None


def muted(node):
    """What is muted of what a node depends on, by name."""
    seen, waiting = set(), [node]
    while waiting:
        each = waiting.pop()
        if each in seen:
            continue
        seen.add(each)
        if each.mute:
            yield f"node '{each.name}'"
        for link in (link for socket in each.inputs for link in socket.links):
            waiting.append(link.from_node)
            if link.is_muted:
                yield f"a link to node '{each.name}'"
        end = group_output(each)
        if end is not None:
            waiting.append(end)


def group_output(node):
    """The node that a group ends with, or None."""
    if node.type != "GROUP" or node.node_tree is None:
        return None
    outputs = [each for each in node.node_tree.nodes if each.type == "GROUP_OUTPUT"]
    active = [each for each in outputs if each.is_active_output]
    return (active or outputs or [None])[0]


def of_surface(material):
    """The nodes that the surface of a material depends on."""
    tree = tree_of(material)
    output = output_of(tree) if tree else None
    return upstream(linked(output, "Surface")) if output else ()


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
        waiting.append(group_output(each))
