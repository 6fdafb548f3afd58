# SPDX-License-Identifier: Apache-2.0
"""Scenes of the corpus as two renderers can be timed on them: one file, larger, without what only one can do."""
import copy
import pathlib
import xml.etree.ElementTree as xml


def included(node, folder, root):
    """The elements of a scene node with its <include>s put in, searched for in `folder`, then in `root`."""
    for child in node:
        if child.tag == "path":
            continue
        if child.tag != "include":
            yield child
            continue
        name = child.get("filename")
        found = next(f / name for f in (folder, *root) if (f / name).exists())
        yield from included(xml.parse(found).getroot(), found.parent, root)


def plain_scene(source, out, size, max_depth=None):
    """Writes `source` to `out`: size × size pixels, a plain path integrator, absolute file names."""
    source = pathlib.Path(source).resolve()
    scene = xml.parse(source).getroot()
    roots = [source.parent / node.get("value") for node in scene.findall("path")]
    plain = xml.Element("scene", version=scene.get("version"))
    for node in included(scene, source.parent, roots):
        plain.append(copy.deepcopy(node))
    defaults = {node.get("name"): node.get("value") for node in reversed(plain.findall("default"))}
    for node in plain.iter():
        for key, value in node.attrib.items():
            if value.startswith("$"):
                node.set(key, defaults[value[1:]])
        if node.get("name") in ("width", "height") and node.tag == "integer":
            node.set("value", str(size))
        if node.get("name") == "filename":
            name = node.get("value")
            node.set("value", str(next((f / name).resolve() for f in (source.parent, *roots) if (f / name).exists())))
        if node.get("name") == "max_depth" and max_depth:
            node.set("value", str(max_depth))
    for node in plain.findall("default"):
        plain.remove(node)
    # The wrapper that also writes second moments.
    for node in plain.findall("integrator"):
        if node.get("type") == "moment":
            plain.append(node.find("integrator"))
            plain.remove(node)
    # Signed-distance grids, which Vitrail does not import.
    gone = {n.get("id") for n in plain.findall("shape") if n.find("shape[@type='sdfgrid']") is not None}
    for node in plain.findall("shape"):
        reference = node.find("ref")
        if node.get("id") in gone and gone or (node.get("type") == "instance" and reference.get("id") in gone):
            plain.remove(node)
    xml.ElementTree(plain).write(out)


def with_samplers(source, out, kinds):
    """Writes `source` to `out`, which lies beside it: its first sensor, and one more for each kind of sampler. Returns `out`."""
    scene = xml.parse(source).getroot()
    own = scene.find("sensor")
    for sensor in scene.findall("sensor")[1:]:
        scene.remove(sensor)
    for kind in kinds:
        sensor = copy.deepcopy(own)
        sensor.attrib.pop("id", None)
        for sampler in sensor.findall("sampler"):
            sensor.remove(sampler)
        xml.SubElement(xml.SubElement(sensor, "sampler", type=kind), "integer", name="sample_count", value="16")
        scene.append(sensor)
    xml.ElementTree(scene).write(out)
    return out
