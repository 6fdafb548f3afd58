# SPDX-License-Identifier: Apache-2.0
"""The package as its users have it; the programs are those of $VITRAIL."""

import gc
import pathlib

import numpy as np
import pytest

import vitrail

BOX = pathlib.Path(__file__).parents[2] / "examples" / "cornell-box" / "cornell-box.pbrt"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("vitrail")


@pytest.fixture(scope="module")
def film(folder):
    return vitrail.render(BOX, folder / "box.png", spp=4, width=40, height=20, spectral=8, aov="albedo,prim_index",
                          stats=folder / "stats.json")


def test_film_is_arrays(film):
    assert (film.width, film.height, film.samples, film.complete) == (40, 20, 40 * 20 * 4, True)
    assert film.rgb.shape == (20, 40, 3) and film.rgb.dtype == np.float32
    assert 0 < film.rgb.mean() < 100
    assert film.variance.shape == (20, 40)
    assert film.spectrum.shape == (20, 40, 8) and (film.spectrum >= 0).all()
    assert film.counts.sum() == film.samples
    assert film.layers["Albedo.R"].dtype == np.float32
    assert film.layers["Id.primitive"].dtype == np.uint32


def test_arrays_share_memory_and_outlive_the_film(film, folder):
    assert film.rgb.ctypes.data == film.rgb.ctypes.data
    assert not film.rgb.flags.writeable and not film.rgb.flags.owndata
    other = vitrail.Film(folder / "box.film")
    rgb = other.rgb
    del other
    gc.collect()
    assert (rgb == film.rgb).all()


def test_film_shows_itself(film, folder):
    assert film._repr_png_() == (folder / "box.png").read_bytes()


def test_statistics(film, folder):
    stats = vitrail.statistics(folder / "stats.json")
    assert stats["film_hash"] == film.hash
    assert stats["rays_camera"] > 0


def test_progress_is_called_and_may_stop(folder):
    events = []
    vitrail.render(BOX, folder / "told.film", spp=1, width=8, height=8, progress=events.append)
    assert events[-1]["event"] == "end"

    def stop(event):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        vitrail.render(BOX, folder / "stopped.film", spp=1, width=8, height=8, progress=stop)


def test_manifest(folder):
    manifest = vitrail.Manifest(vitrail.partition(BOX, folder / "box.vit", domains=4))
    assert manifest.triangles == 36
    assert manifest.domain_bytes.shape == (4,) and manifest.domain_bounds.shape == (4, 2, 3)
    assert [int(b) for b in manifest.domain_bytes] == [
        (folder / "box.vit" / "domains" / f"{i:06}.dom").stat().st_size for i in range(4)]
    assert (manifest.domain_triangles >= manifest.domain_pieces).all()
    assert len(manifest.kd_splits) == len(manifest.kd_axes) == 3
    assert (manifest.bounds[0] < manifest.bounds[1]).all()


def test_convert_reports(folder):
    report = vitrail.convert(BOX, folder / "box.xml")
    assert (folder / "box.xml").exists() and report


def test_spectra():
    values = vitrail.spectrum("glass-BK7")
    assert values.shape == vitrail.wavelengths.shape == (471,)
    assert values[np.searchsorted(vitrail.wavelengths, 588)] == pytest.approx(1.5168, abs=1e-4)
    assert "metal-Cu-eta" in vitrail.spectrum_names()


def test_errors_say_what_is_wrong(folder):
    with pytest.raises(ValueError, match="did you mean glass-BK7"):
        vitrail.spectrum("glas-BK7")
    with pytest.raises(ValueError, match="none.film"):
        vitrail.Film(folder / "none.film")
    with pytest.raises(vitrail.ProgramError, match="no such file") as failed:
        vitrail.render(folder / "none.pbrt", folder / "a.png")
    assert failed.value.status == 3
