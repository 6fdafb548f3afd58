# SPDX-License-Identifier: Apache-2.0
"""A UsdGeomCamera as a sensor of Mitsuba 3."""

import sys

import numpy as np
from pxr import Gf, UsdGeom, UsdRender

from mitsuba_xml import TURNED, bounds, column_matrix, element, number, placed, rigid, with_children


def sensor(stage, time, cameras, note, name, width, samples):
    """The sensor of a name or path among cameras, of the first without; width: of the picture, or nothing."""
    chosen = [prim for prim in cameras if name in (None, prim.GetName(), str(prim.GetPath()))]
    if name and not chosen:
        sys.exit(f"no camera {name}; there are: {', '.join(str(prim.GetPath()) for prim in cameras)}")
    if chosen:
        camera = UsdGeom.Camera(chosen[0]).GetCamera(time)
        exposure = UsdGeom.Camera(chosen[0]).ComputeLinearExposureScale(time)
        if abs(exposure - 1) > 1e-6:
            note(f"exposure of a camera, {exposure:.4g}: left out", chosen[0])
        fstop, focus = camera.fStop, camera.focusDistance
    else:
        note("no camera: one that sees all", stage.GetPseudoRoot())
        camera, fstop, focus = made_up_camera(stage, time), 0, 0
    wide, high = camera.horizontalAperture, camera.verticalAperture
    shift = np.array([camera.horizontalApertureOffset, camera.verticalApertureOffset])
    world = rigid(column_matrix(camera.transform)) @ TURNED
    if camera.projection == Gf.Camera.Orthographic:  # apertures are tenths of a unit
        out = element("sensor", "orthographic")
        move = np.eye(4)
        move[:2, 3] = shift / 10 * (-1, 1)
        out.append(placed(world @ move @ np.diag([wide / 20, wide / 20, 1, 1])))
    else:
        lens = camera.focalLength / 10 / (2 * fstop) if fstop > 0 and focus > 0 else 0
        out = element("sensor", "thinlens" if lens else "perspective")
        fov = number("fov", np.degrees(2 * np.arctan(wide / 2 / camera.focalLength)))
        with_children(out, element("string", name="fov_axis", value="x"), fov, placed(world))
        if lens:
            with_children(out, number("aperture_radius", lens), number("focus_distance", focus))
        if shift.any() and lens:
            note("apertureOffset of a camera with fStop: left out", chosen[0])
        elif shift.any():
            out.append(number("principal_point_offset_x", shift[0] / wide))
            out.append(number("principal_point_offset_y", -shift[1] / high))
    return with_children(out, *film(stage, time, width, high / wide, samples))


def made_up_camera(stage, time):
    centre, size = bounds(stage, time)
    centre, up = Gf.Vec3d(*centre), UsdGeom.GetStageUpAxis(stage)
    eye = centre + Gf.Vec3d(*((0.6, 0.5, 1) if up == "Y" else (0.6, -1, 0.5))) * 1.2 * size
    view = Gf.Matrix4d().SetLookAt(eye, centre, Gf.Vec3d(0, 1, 0) if up == "Y" else Gf.Vec3d(0, 0, 1))
    return Gf.Camera(view.GetInverse(), horizontalAperture=36, verticalAperture=27, focalLength=50)


def film(stage, time, width, aspect, samples):
    size = (width, max(1, round(width * aspect))) if width else None
    settings = [prim for prim in stage.Traverse() if prim.IsA(UsdRender.Settings)]
    if size is None and settings:
        size = UsdRender.Settings(settings[0]).GetResolutionAttr().Get(time)
    size = size or (960, max(1, round(960 * aspect)))
    integers = [element("integer", name=key, value=str(n)) for key, n in zip(("width", "height"), size)]
    picture = with_children(element("film", "hdrfilm"), *integers, element("rfilter", "box"))
    count = element("integer", name="sample_count", value=str(samples))
    return picture, with_children(element("sampler", "independent"), count)
