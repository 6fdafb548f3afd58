// SPDX-License-Identifier: Apache-2.0
#include "cli/help/verbs.h"

#include <algorithm>

namespace vitrail {

std::span<const Verb> verbs() {
  constexpr bool contains_cgal = true;
  static const std::vector<Verb> all{
      {"render",
       "render a scene or a bundle, alone or under mpirun",
       {{"vitrail render room.pbrt -o room.png --quality draft", "a first picture"},
        {"vitrail render room.pbrt -o room.exr --spp 256 --memory 4G",
         "a linear picture, with 4 GiB of memory at most"},
        {"mpirun -np 8 vitrail render room.vit -o room.exr --time 3600",
         "the best picture of 8 ranks in an hour"}}},
      {"inspect",
       "print the contents and the needs of a scene, a bundle or a film",
       {{"vitrail inspect room.pbrt", "its contents, and its approximations"},
        {"vitrail inspect room.vit --json", "the same of a bundle, for programs"},
        {"vitrail inspect room.film", "how many samples it has, and with which options it was rendered"}},
       contains_cgal},
      {"convert",
       "write a scene in another format",
       {{"vitrail convert room.pbrt room.xml", "from PBRT to Mitsuba 3"},
        {"vitrail convert room.pbrt room.xml --report room.json",
         "lists each item as exact, approximated or dropped"},
        {"vitrail convert scenes/ --to xml -o converted --check",
         "a whole folder; says which scenes look different"}},
       contains_cgal},
      {"develop",
       "make a picture of films",
       {{"vitrail develop room.film -o room.png --exposure 1", "one stop brighter"},
        {"vitrail develop a.film b.film -o both.exr", "films of different seeds, merged"},
        {"vitrail develop room.film -o light.png --false-color auto", "luminance in cd/m², with a scale"}}},
      {"compare",
       "compare a picture with a reference",
       {{"vitrail compare room.exr reference.exr", "the relative mean squared error"},
        {"vitrail compare room.exr reference.exr --fail-above 0.01", "exit status 1 where it is greater"},
        {"vitrail compare room.exr reference.exr --html page.html", "both and their errors in a browser"}}},
      {"partition",
       "cut a scene into sub-domains: a bundle",
       {{"vitrail partition city.pbrt -o city.vit", "sub-domains of 64 MiB"},
        {"vitrail partition city.pbrt -o city.vit --memory 4G",
         "the scene may be larger than memory, which chooses the sub-domains"},
        {"vitrail partition city.pbrt -o city.vit --profile rays.json",
         "cut where the rays of an earlier render went"}},
       contains_cgal},
      {"verify",
       "read every byte of a bundle and report damage",
       {{"vitrail verify city.vit", "after a copy, for example"},
        {"vitrail verify city.vit --json", "for programs"},
        {"vitrail verify city.vit --strict --quiet",
         "for scripts: the exit status is the result, and warnings count"}}},
      {"plan",
       "simulate the render of a bundle on a cluster",
       {{"vitrail plan city.vit --profile rays.json", "seconds and efficiency of 1 to 1024 ranks"},
        {"vitrail plan city.vit --profile rays.json --threads 32 --memory 64G", "ranks as large as a node"},
        {"vitrail plan city.vit --profile rays.json --svg plan.svg", "as a plot"}}},
      {"measure",
       "measure the price of each setting on a scene, and recommend one",
       {{"vitrail measure room.pbrt -o measured", "writes measured/index.html"},
        {"vitrail measure room.pbrt -o measured --error 0.01", "the cheapest setting of that error"},
        {"vitrail measure room.pbrt -o measured --seconds 60", "the most accurate setting of that time"}}},
      {"glazing",
       "print transmittance, reflectance and colour of panes; write data sheets",
       {{"vitrail glazing clear.dat", "one pane, at normal incidence"},
        {"vitrail glazing low-e.json clear.dat --gap 16:argon --report sheet.html",
         "a data sheet, with U and g"},
        {"vitrail glazing low-e.json clear.dat --theta 0 60", "two panes from outside, at two angles"}}},
      {"sky",
       "print the sun's position, and the light of sun and sky",
       {{"vitrail sky 48.86,2.35,2026-06-21T12:00+02:00", "Paris at noon"},
        {"vitrail sky 48.86,2.35,2026-06-21T12:00+02:00 -o sky.exr", "the sky as a picture"},
        {"vitrail sky 48.86,2.35,2026-12-21T12:00+01:00,turbidity=5 --json", "hazy air, for programs"}}},
      {"year",
       "daylight over a year of weather: lux, DA, UDI, sDA, EN 17037",
       {{"vitrail year room.vit --weather paris.epw --sensors desk.txt -o year",
         "tables, and a page with maps"},
        {"vitrail year room.vit --weather a.epw --sensors a.txt -o year --patches 1", "a fast first look"},
        {"mpirun -np 8 vitrail year room.vit --weather a.epw --sensors a.txt -o year",
         "the same bytes by 8 ranks"}}},
      {"spectrum",
       "print reflectances made from RGB, and their errors",
       {{"vitrail spectrum", "two methods against measured patches"},
        {"vitrail spectrum --rgb 0.8,0.2,0.1", "one colour as a table"},
        {"vitrail spectrum --picture photo.png --plot patches.svg", "the colours of a picture, and a plot"}}},
  };
  return all;
}

const Verb* find_verb(std::string_view name) {
  const auto found = std::ranges::find(verbs(), name, &Verb::name);
  return found == verbs().end() ? nullptr : &*found;
}

std::span<const Example> first_steps() {
  static const std::vector<Example> steps{
      {"vitrail render scene.pbrt -o picture.png --quality draft", "a first picture"},
      {"vitrail inspect scene.pbrt", "the contents of a scene"},
      {"vitrail convert scene.pbrt scene.xml", "the scene in another format"},
      {"vitrail help render", "what nearly everyone needs of a verb; render --help-all has every option"},
  };
  return steps;
}

}  // namespace vitrail
