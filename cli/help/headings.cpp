// SPDX-License-Identifier: Apache-2.0
#include "cli/help/headings.h"

namespace vitrail {

namespace {

constexpr Heading scene{
    "How the scene is read",
    "define=NAME=VALUE camera sky=SKY glazing=MATERIAL=FILE lamps rgb all-media missing include=FOLDER "
    "root=FOLDER "
    "include-limit=SIZE token-limit=COUNT call-limit=COUNT nesting-limit=COUNT write-limit=SIZE no-cache "
    "strict"};
constexpr Heading scene_of_render{
    "How the scene is read",
    "define=NAME=VALUE glazing=MATERIAL=FILE rgb all-media missing include=FOLDER "
    "root=FOLDER include-limit=SIZE token-limit=COUNT "
    "call-limit=COUNT nesting-limit=COUNT write-limit=SIZE no-cache strict"};
constexpr Heading meshes{"Changes to its meshes",
                         "tessellate=SEGMENTS repair orient subdivide=LEVELS decimate=FRACTION"};

const std::vector<Heading> of_render{
    {"What to render",
     "input=SCENE|BUNDLE output=FILE width=PIXELS height=PIXELS scale=FACTOR crop=X0,X1,Y0,Y1 max-depth "
     "integrator "
     "hide-emitters "
     "camera=FILE look-at=X,Y,Z,X,Y,Z fov=DEGREES frames=FILE range=NUMBERS sensors=FILE "
     "sky=SKY lamps set=NAME.PROPERTY=VALUE"},
    {"How good", "quality spp target-error=ERROR adaptive seed clamp=RADIANCE denoise find-denoiser"},
    {"How long",
     "time=SECONDS dry-run checkpoint-every=SECONDS resume force restarts=TIMES launcher=COMMAND "
     "retries=TIMES"},
    {"On how many", "threads distribution traversal homes=FILE patience=SECONDS"},
    {"In how much memory", "memory=SIZE"},
    {"What to write",
     "film=FILE preview=FILE display-server=HOST:PORT aov=LAYERS aov-space alpha light-groups "
     "light-group=NAME=LIGHTS spectral=BINS stats=FILE profile=FILE trace=FILE "
     "progress quiet"},
    {"How to sample",
     "filter=NAME[:RADIUS] splat one-sequence texture-filter roulette wavelengths light-sampling "
     "light-candidates threshold=SHARE"},
    {"Photon mapping", "photons photon-radius=LENGTH photon-alpha"},
    scene_of_render,
    meshes,
};

const std::vector<Heading> of_partition{
    {"What to cut, and into how many",
     "input=SCENE output=BUNDLE domains domain-bytes=SIZE profile=FILE flatten"},
    {"With what", "memory=SIZE threads"},
    {"What to write", "aov=LAYERS pack=SIZE stats=FILE no-sync force progress quiet"},
    scene,
    meshes,
    {"To measure what partitioning saves", "require-everything median-cuts"},
};

const std::vector<Heading> of_convert{
    {"What to convert", "files=FILE output=FILE to jobs again"},
    {"What to write", "pack report=FILE check peer=PROGRAM peer-of-input=PROGRAM memory=SIZE force quiet"},
    scene,
    meshes,
};

const std::vector<Heading> of_compare{
    {"What to compare", "IMAGE=IMAGE REFERENCE=REFERENCE resize ignore=X0,X1,Y0,Y1 mask=IMAGE strict"},
    {"By what", "metric flip-range pixels-per-degree variance=FILE variance-samples"},
    {"When to fail", "fail-above=VALUE mean-within=FRACTION"},
    {"What to write",
     "heatmap=FILE signed-map=FILE map-scale=ERROR html=FILE worst memory=SIZE json force quiet"},
};

const std::vector<Heading> of_develop{
    {"What to develop", "FILM=FILM layer=NAME layers=NAMES crop=X0,X1,Y0,Y1 resize=SIZE strict"},
    {"How it looks",
     "groups=NAME=WEIGHT,… exposure=STOPS white-balance=KELVIN tone false-color=MAXIMUM log denoise "
     "find-denoiser"},
    {"What to write", "output=FILE bits variance spectral memory=SIZE force quiet"},
};

const std::vector<Heading> of_inspect{
    {"What to inspect", "file=FILE strict"},
    {"Output", "json quiet"},
    {"In how much memory", "memory=SIZE"},
    scene,
};

const std::vector<Heading> of_measure{
    {"What to measure", "input=SCENE|BUNDLE axes=NAMES every-combination"},
    {"What to recommend", "error=RELMSE seconds=SECONDS bias=SHARE ranks threads"},
    {"How thoroughly", "budget=SECONDS width=PIXELS seeds spp reference-spp"},
    {"What to write", "output=FOLDER quiet"},
};

const std::vector<Heading> of_plan{
    {"What to simulate", "bundle=BUNDLE profile=FILE times"},
    {"On which cluster",
     "ranks threads memory=SIZE latency=MICROSECONDS network=SIZE disk=SIZE disk-latency=MILLISECONDS "
     "scratch=SIZE "
     "ranks-a-disk ranks-a-link=N files-a-second=N slow-rank=X distribution homes=FILE"},
    {"What to write", "svg=FILE json force"},
};

const std::vector<Heading> of_glazing{
    {"Which panes", "files=FILE flip=PANE gap=MM[:GAS] state temperature=CELSIUS"},
    {"How to evaluate them", "theta=DEGREES standard=FILE sampling unpolarised"},
    {"What to write", "report=FILE energyplus=FILE csv=FILE json force"},
};

const std::vector<Heading> of_sky{{"Where and when", "SKY=SKY"},
                                  {"What to write", "output=FILE height=PIXELS json"}};

const std::vector<Heading> of_year{
    {"What to measure",
     "bundle=BUNDLE weather=FILE file-lux sensors=FILE up=AXIS north=AXIS ground=REFLECTANCE "
     "set=NAME.PROPERTY=VALUE "
     "state=NAME=SETTINGS rules=FILE blinds=STATE use=HOURS target=LUX sun-day=DAY "
     "sun-above=DEGREES heat=GLASS photochromic"},
    {"How good", "patches paths=COUNT sun-paths=COUNT sun-blur=DEGREES max-depth seed"},
    {"How long", "checkpoint-every=SECONDS force"},
    {"On how many", "memory=SIZE threads patience=SECONDS"},
    {"What to write", "output=FOLDER table progress quiet"},
};

const std::vector<Heading> of_spectrum{
    {"Which colours", "rgb=R,G,B cube=SIDE picture=FILE"},
    {"What to write", "csv=FILE plot=FILE json force"},
};

const std::vector<Heading> of_verify{{"What to read", "bundle=BUNDLE threads strict"},
                                     {"Output", "json quiet"}};

}  // namespace

std::span<const Heading> headings(std::string_view verb) {
  if (verb == "compare") return of_compare;
  if (verb == "convert") return of_convert;
  if (verb == "develop") return of_develop;
  if (verb == "glazing") return of_glazing;
  if (verb == "inspect") return of_inspect;
  if (verb == "measure") return of_measure;
  if (verb == "partition") return of_partition;
  if (verb == "plan") return of_plan;
  if (verb == "render") return of_render;
  if (verb == "sky") return of_sky;
  if (verb == "year") return of_year;
  if (verb == "spectrum") return of_spectrum;
  if (verb == "verify") return of_verify;
  return {};
}

std::string_view everyday_options(std::string_view verb) {
  if (verb == "render")
    return "input output quality spp denoise width height camera look-at sky set time memory threads resume "
           "force "
           "dry-run quiet";
  if (verb == "partition") return "input output domains memory threads sky force quiet";
  if (verb == "convert") return "files output to check report sky camera quiet";
  if (verb == "year")
    return "bundle weather sensors output state rules blinds heat up north paths use target memory threads "
           "force quiet";
  return {};
}

}  // namespace vitrail
