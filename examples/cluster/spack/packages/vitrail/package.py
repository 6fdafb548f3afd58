# SPDX-License-Identifier: Apache-2.0
# Where nodes have no Debian packages: `spack repo add examples/cluster/spack`, then in a clone
# `spack dev-build vitrail@0.1.0`. It is the clone that is built.
from spack.package import *


class Vitrail(CMakePackage):
    """Converts scenes and renders them spectrally, on the ranks of a cluster that share the scene."""

    license("Apache-2.0 AND GPL-3.0-or-later")  # programs that contain CGAL: THIRD_PARTY.md

    version("0.1.0")

    variant("tests", default=False, description="Build the tests")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")

    depends_on("mpi@3:")
    depends_on("tbb")
    depends_on("embree@3")
    depends_on("fmt@9:")
    depends_on("sleef")
    depends_on("zlib-api")
    depends_on("libpng")
    depends_on("libjpeg-turbo")
    depends_on("openexr@3:")
    depends_on("freetype")
    depends_on("pugixml")
    depends_on("openmesh")
    depends_on("openimageio@2.4:")
    depends_on("opencolorio@2.1:")
    # Headers alone.
    depends_on("xxhash", type="build")
    depends_on("nlohmann-json", type="build")
    depends_on("cli11", type="build")
    depends_on("fast-float", type="build")
    depends_on("tinygltf", type="build")
    depends_on("nanovdb", type="build")
    depends_on("cgal", type=("build", "link"))
    depends_on("googletest+gmock", type=("build", "test"), when="+tests")

    conflicts("%gcc@:11", msg="the sources are C++20")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("VITRAIL_TESTS", "tests"),
            self.define("VITRAIL_BENCH", False),
            self.define("CMAKE_BUILD_TYPE", "Release"),
        ]

    def setup_run_environment(self, env):
        env.prepend_path("MANPATH", self.prefix.share.man)

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def render_a_picture(self):
        vitrail = Executable(self.prefix.bin.vitrail)
        vitrail("--version")
        scene = join_path(self.stage.source_path, "examples", "cornell-box", "cornell-box.pbrt")
        vitrail("render", scene, "-o", "box.exr", "--spp", "1", "--quiet", "--force")
