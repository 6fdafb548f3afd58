# SPDX-License-Identifier: Apache-2.0
"""What speed.py measured as docs/why/speed.md and two plots."""
import math
import textwrap

COLOURS = {"vitrail": "#1b6f8a", "llvm_ad_spectral": "#d1762c", "llvm_ad_rgb": "#b8a12c", "scalar_spectral": "#8f8f8f", "cycles": "#5b8c3a", "pbrt": "#8a4f9e"}
LABELS = {"vitrail": "Vitrail", "llvm_ad_spectral": "Mitsuba, llvm_ad_spectral", "scalar_spectral": "Mitsuba, scalar_spectral",
          "llvm_ad_rgb": "Mitsuba, llvm_ad_rgb", "cycles": "Cycles", "pbrt": "pbrt-v4"}
COLUMNS = LABELS | {"llvm_ad_spectral": "Mitsuba, llvm", "llvm_ad_rgb": "Mitsuba, llvm, RGB", "scalar_spectral": "Mitsuba, scalar"}

TEXT = """# Speed

`tests/bench/speed.py` measured these numbers and wrote this page. All are of one run on one machine. Compare
ratios; seconds are of that machine.

## To a given error, beside each peer's best

One thread each, start-up left out, pictures of {size} × {size} pixels. A renderer's *noise* is the relative mean
square error between two seeds, so differences of models do not count. Its *time* is processor time, the lesser of
the two. Noise falls as 1/time, or faster, so time × noise measures a renderer.

The table has time × noise of the peer over that of Vitrail, at {spp} samples a pixel. **Above 1, Vitrail is sooner at
the same error; below, the peer is.** Vitrail runs with its defaults.

{peers}

{table}

{verdict}

{missing}

![ratios](../images/speed-ratios.svg)

Nanoseconds a sample · noise, of Vitrail with its defaults and of each peer at its best.
{marks}

{details}

Each panel is one scene: noise against nanoseconds a pixel, from {least} to {spp} samples a pixel.

![noise against time](../images/speed-noise.svg)

### Other ways to sample

Some scenes gain from another way than path tracing with the usual samples. The peers stay at their best, with path
tracing:

- `--integrator photon --photons N`, a photon a pixel and iteration, for light that glass and white walls gather;
- `--one-sequence`, where the film need not know its error, as those of the peers do not;
- `--splat`, where the scene's filter is wider than a pixel, which is how Mitsuba filters;
- `--adaptive`, where a part of the picture has most of the noise.

Photons have a bias, so their *error* counts in place of noise: the error to 4096 paths a pixel of Mitsuba, less the
noise of those. The last row has the best way for each scene.

{ways}

Notes on the rows:

- *hotel room*, *city*: Mitsuba's path tracer cannot connect through panes to the sun. Its picture lacks the sunlight
  in the rooms (the means show it), and with it most of our noise. The two do not solve the same problem there.
- The pixel filters of these two and of *Cornell of Tungsten* are wider than a pixel. Mitsuba
  adds each sample to several pixels, as Vitrail does with `--splat`. Otherwise Vitrail chooses the sample's place by
  the filter. `--splat` makes neighbouring pixels alike, and this measure counts that as less noise.
- *killeroo-simple*: Mitsuba gets the spherical lamps of PBRT from `vitrail convert`.
- The table has the difference of means where it exceeds the noise. The models then differ, and the row says less.
- Cycles gets spheres as meshes of 131,000 triangles; the others get spheres. Lamps of Cycles let light through, so it
  sees the ceiling behind them: its means are 1 % higher. It computes in RGB; the others sample wavelengths.

## Where the time goes

Shares of processor time in percent, of fourteen rows, by `tests/bench/stages.py` (AVX-512, 64 samples,
start-up included, other programs beside it). *Shading* has BSDFs and lights, which are one stage in lanes. *Begin*
has all that a sample costs before its first ray: numbers, wavelengths, the sensor, its camera ray, the state of a
path. The last columns say how many times as fast a render would be without intersection, and without shading.

| | intersection | shading | film | begin | lists, hits | no intersection | no shading |
|---|---|---|---|---|---|---|---|
| arealight | 36 | 32 | 4 | 18 | 11 | 1.56 | 1.47 |
| envmap | 24 | 51 | 8 | 11 | 6 | 1.32 | 2.04 |
| various shapes | 20 | 22 | 20 | 33 | 6 | 1.25 | 1.28 |
| box, diffuse | 35 | 39 | 8 | 10 | 8 | 1.54 | 1.64 |
| box, spheres | 41 | 38 | 6 | 7 | 7 | 1.69 | 1.61 |
| cbox of Mitsuba | 35 | 40 | 7 | 9 | 8 | 1.54 | 1.67 |
| Cornell of Tungsten | 34 | 41 | 8 | 9 | 8 | 1.52 | 1.69 |
| glass | 32 | 41 | 5 | 6 | 17 | 1.47 | 1.69 |
| medium | 29 | 55 | 4 | 3 | 8 | 1.41 | 2.22 |
| four lamps | 33 | 52 | 4 | 8 | 3 | 1.49 | 2.08 |
| Veach's plates | 27 | 55 | 4 | 10 | 4 | 1.37 | 2.22 |
| killeroo-simple | 51 | 29 | 5 | 8 | 7 | 2.04 | 1.41 |
| hotel room | 66 | 25 | 1 | 1 | 6 | 2.94 | 1.33 |
| city, 10⁶ triangles | 56 | 31 | 3 | 5 | 5 | 2.27 | 1.45 |

Without intersection arealight, medium, four lamps and the hotel room would be won; without shading arealight, envmap,
medium and four lamps. *box, spheres* and killeroo-simple would be lost without either. What is left has these reasons:

- *Doubles.* Shading takes 8 doubles in a register of AVX-512, Mitsuba 16 floats. The film is one bit pattern for any
  division of the work, and decisions near an edge need doubles. With 16 lanes in two registers each, shading was 20 to
  25 % slower ([waves](waves.md)).
- *Trees.* In trees of more than one node rays go one by one, with eight boxes or triangles as lanes. In arealight 37 %
  of a tree's samples lie on two instructions: the first behind the branch to a node or to triangles, which is guessed
  wrongly. `llvm_ad_spectral` gives Embree many rays at once, which share these guesses. Eight camera rays at a time
  gained 1.3 in the city's tree and lost in killeroo-simple ([waves](waves.md)).
- *Two sequences.* They cost 0 to 20 % of the noise, and no cheaper estimate of the error was found
  ([better samples](sampling.md#halves-of-one-sequence-as-groups)).
- *The beginning of a sample.* Where paths end at once, as in *various shapes*, it is a third of the time. Over a
  third of that is four wavelengths and what the sensor makes of them. A table of ready ones was not kept
  ([better samples](sampling.md#costs-that-stay)).

To pass, hotel room and city need rays that share the way through big trees. Rows of shading need 16 floats where no bit
of the film hangs on it.

## Beside its own intersector

On a room of 1.06 million triangles (`bench_render`), seconds of processors:

| | |
|---|---|
| rays a second, whole render ÷ bare intersector with the same rays | {bare:.2f} |
| 64 domains ÷ 1, all in memory | {domains:.2f} |
| a render of one pixel of a box of 36 triangles, all of the process: from the scene file | {start_scene:.3f} s |
| … from its bundle | {start_bundle:.3f} s |

## Again

```
pip install mitsuba numpy && apt-get install libllvm19     # Debian's LLVM 14 and 15 crash on recent processors
python3.11 -m venv VENV && VENV/bin/pip install bpy==4.5.15 # Cycles: 350 MB, GPL-3.0; a Python of its own, for its numpy is older
tests/bench/speed.py --bin build/release/bin --bpy VENV/bin/python [--pbrt PBRT]  # {minutes:.0f} minutes; writes this page
tests/bench/speed.py --quick --bpy VENV/bin/python         # smaller and with fewer samples; prints the table
tests/bench/speed.py --also crown=crown.pbrt               # a scene that the corpus has not
tests/bench/stages.py BUNDLE…                              # where the time goes; needs Linux's perf
```
"""


def wrapped(words):
    """A paragraph or an item of a list in lines of at most 112 columns."""
    return textwrap.fill(words, 112, subsequent_indent="  " if words.startswith("- ") else "", break_long_words=False, break_on_hyphens=False)


def bold(r):
    return f"**{r:.2f}**" if r < 1 else f"{r:.2f}"


def mean_of(ratios):
    return f"{math.prod(ratios) ** (1 / len(ratios)):.2f}" if ratios else "—"


def rows_of(result, best):
    """Renderer → its rows at its best; those alone that have some."""
    return {"vitrail": result["rows"]["vitrail", ""]} | {p: result["rows"][p, way] for p, way in best.items() if way is not None}


def ns_of(row, result):
    return f"{1e9 * row['seconds'] / result['pixels'] / row['spp']:.0f}"


def table(found):
    """The ratios; what a peer cannot be given is a dash."""
    ratios = found["ratios"]
    lines = [f"| | {' | '.join(COLUMNS[p] for p in ratios)} | means |", "|---" * (len(ratios) + 2) + "|"]
    for name, result in found["results"].items():
        means = [rows[-1]["mean"] for rows in rows_of(result, found["best"][name]).values()]
        apart = max(abs(mean / means[0] - 1) for mean in means)
        lines.append(f"| {name} | {' | '.join(bold(of[name]) if name in of else '—' for of in ratios.values())} | within {100 * apart:.1f} % |")
    return "\n".join([*lines, f"| geometric mean | {' | '.join(mean_of(list(of.values())) for of in ratios.values())} | |"])


# Of the peers' ways, in the table of details.
MARKS = {"multijitter": "ᵐ", "uniform": "ᵘ"}


def details(found):
    renderers = ["vitrail", *found["ratios"]]
    lines = [f"| | {' | '.join(COLUMNS[r] for r in renderers)} |", "|---" * (len(renderers) + 1) + "|"]
    for name, result in found["results"].items():
        rows, best = rows_of(result, found["best"][name]), found["best"][name]
        cell = lambda r: f"{ns_of(rows[r][-1], result)} · {rows[r][-1]['noise']:.2g}{MARKS.get(best.get(r), '')}" if r in rows else "—"
        lines.append(f"| {name} | {' | '.join(cell(r) for r in renderers)} |")
    return "\n".join(lines)


def table_of_ways(found):
    results, ratios, by_ways = found["results"], found["ratios"], found["by_ways"]
    lines = [f"| | {' | '.join(COLUMNS[p] for p in ratios)} | ns a sample | noise | error | mean ÷ that of paths |",
             "|---" * (len(ratios) + 5) + "|"]
    for name, result in results.items():
        paths = result["rows"]["vitrail", ""][-1]
        for way, row in result["ways"].items():
            err = f"{row['error']:.2g}" if "error" in row else ""
            each = " | ".join(bold(of[name, way]) if (name, way) in of else "—" for of in by_ways.values())
            lines.append(f"| {name}, {way} | {each} | {1e9 * row['seconds'] / result['pixels'] / paths['spp']:.0f} | {row['noise']:.2g} | "
                         f"{err} | {row['mean'] / paths['mean']:.4f} |")
    better = [mean_of([max([r, *(v for (n, _), v in by_ways[p].items() if n == name)]) for name, r in of.items()])
              for p, of in ratios.items()]
    return "\n".join([*lines, f"| geometric mean of all scenes | {' | '.join(better)} | | | | |"])


def verdict(ratios):
    words = []
    for p, of in ratios.items():
        lost = [name for name, r in of.items() if r < 1]
        words.append(f"to {LABELS[p]} on {len(lost)} of {len(of)}" + (f" ({'; '.join(lost)})" if lost else ""))
    return "Bold: lost. Vitrail loses " + "; ".join(words) + "."


PEERS = {
    "llvm_ad_spectral": "- *Mitsuba {version}*: `llvm_ad_spectral` traces whole pictures as streams of lanes, `scalar_spectral` a path at a time. Each has "
                        "the sampler of the scene, `independent` in nearly all, and `multijitter`; the better one counts. Scenes of Mitsuba's format are one "
                        "file to both; those of PBRT are handed over by `vitrail convert`.",
    "cycles": "- *Cycles*, of Blender's `bpy`, in RGB: on its CPU device, with its default sampler and light tree; adaptive sampling as by default, "
              "and off; the better one counts. Off, too, is what changes the picture: denoiser, clamps, the blur of caustics. It gets the scenes that "
              "`cycles_timing.py` can build.",
    "pbrt": "- *pbrt-v4*, with `zsobol`, its default. All scenes are handed over by `vitrail convert`.",
}


def missing(options, found):
    words = [f"{LABELS[p]} is left out: {why}." for p, why in options.missing.items()]
    refused = {}
    for name, result in found["results"].items():
        for p, why in result["refused"].items():
            refused.setdefault((p, why), []).append(name)
    words += [f"{LABELS[p]} has no {'; '.join(names)}: {why}." for (p, why), names in refused.items()]
    absent = {}
    for name, why in found["absent"].items():
        absent.setdefault(why, []).append(name)
    return " ".join(words + [f"Not measured, {why}: {'; '.join(names)}." for why, names in absent.items()])


def svg(width, height, parts):
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11">'
    return "\n".join([head, f'<rect width="{width}" height="{height}" fill="#fff"/>', *parts, "</svg>\n"])


def text(x, y, what, anchor="start", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{what}</text>'


def legend(names, y):
    return [part for i, n in enumerate(names) for part in (
        f'<rect x="{170 + 190 * i}" y="{y - 9}" width="10" height="10" fill="{COLOURS[n]}"/>', text(185 + 190 * i, y, LABELS[n]))]


def ratios_plot(ratios):
    """Bars from 1, on a logarithmic axis."""
    names = list(dict.fromkeys(name for of in ratios.values() for name in of))
    values = [r for of in ratios.values() for r in of.values()]
    low, high = min(.5, *values) / 1.15, max(2, *values) * 1.25
    left, width, row = 170, 480, 34
    x = lambda r: left + width * math.log(r / low) / math.log(high / low)
    bottom = 40 + row * len(names)
    parts = legend(ratios, 18)
    bar = 26 / len(ratios)
    for tick in (.1, .2, .5, 1, 2, 5, 10):
        if low < tick < high:
            parts += [f'<line x1="{x(tick):.1f}" y1="32" x2="{x(tick):.1f}" y2="{bottom}" stroke="{"#000" if tick == 1 else "#ddd"}"/>',
                      text(x(tick), bottom + 14, f"{tick}×", "middle")]
    for i, name in enumerate(names):
        y = 40 + row * i
        parts.append(text(left - 8, y + 16, name, "end"))
        for k, (p, of) in enumerate(ratios.items()):
            if name not in of:
                continue
            a, b = sorted((x(1), x(of[name])))
            top = y + 2 + bar * k
            parts += [f'<rect x="{a:.1f}" y="{top}" width="{b - a:.1f}" height="{bar - 2:.1f}" fill="{COLOURS[p]}"/>',
                      text(x(of[name]) + (4 if of[name] > 1 else -4), top + bar / 2 + 2.5, f"{of[name]:.2f}", "start" if of[name] > 1 else "end")]
    parts += [text(x(1) + 6, bottom + 30, "Vitrail is sooner →"), text(x(1) - 6, bottom + 30, "← the peer is sooner", "end")]
    return svg(left + width + 40, bottom + 40, parts)


def panel(name, result, best, left, top, side=190):
    """Noise against time of the renderers on one scene; both axes logarithmic, decades marked."""
    points = {r: [(1e9 * row["seconds"] / result["pixels"], row["noise"]) for row in rows] for r, rows in rows_of(result, best).items()}
    every = [p for of in points.values() for p in of]
    bounds = [(min(v) / 1.3, max(v) * 1.3) for v in zip(*every)]
    part = lambda v, k: math.log(v / bounds[k][0]) / math.log(bounds[k][1] / bounds[k][0])
    x, y = (lambda v: left + side * part(v, 0)), (lambda v: top + side * (1 - part(v, 1)))
    out = [f'<rect x="{left}" y="{top}" width="{side}" height="{side}" fill="none" stroke="#999"/>',
           text(left + side / 2, top - 6, name, "middle", 'font-weight="bold"')]
    superscript = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    for k, (low, high) in enumerate(bounds):
        for decade in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1):
            v, label = 10.0 ** decade, "10" + str(decade).translate(superscript)
            out += ([f'<line x1="{x(v):.1f}" y1="{top}" x2="{x(v):.1f}" y2="{top + side}" stroke="#ddd"/>',
                     text(x(v), top + side + 13, label, "middle")] if k == 0 else
                    [f'<line x1="{left}" y1="{y(v):.1f}" x2="{left + side}" y2="{y(v):.1f}" stroke="#ddd"/>',
                     text(left - 4, y(v) + 4, label, "end")])
    for r, of in points.items():
        line = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in of)
        out.append(f'<polyline points="{line}" fill="none" stroke="{COLOURS[r]}" stroke-width="2"/>')
        out += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="3" fill="{COLOURS[r]}"/>' for a, b in of]
    return out


def noise_plot(found, columns=4):
    parts = legend(["vitrail", *found["ratios"]], 18)
    for i, (name, result) in enumerate(found["results"].items()):
        parts += panel(name, result, found["best"][name], 50 + 240 * (i % columns), 50 + 240 * (i // columns))
    return svg(240 * columns + 20, 50 + 240 * math.ceil(len(found["results"]) / columns), parts)


def write_page(options, found, seconds, version):
    folder, own = options.out, found["own"] or dict.fromkeys(("bare", "domains", "start_scene", "start_bundle"), math.nan)
    (folder / "images").mkdir(parents=True, exist_ok=True)
    (folder / "images/speed-ratios.svg").write_text(ratios_plot(found["ratios"]))
    (folder / "images/speed-noise.svg").write_text(noise_plot(found))
    used = {way for best in found["best"].values() for way in best.values()}
    marks = ["multijitter ᵐ"] * ("multijitter" in used) + ["without adaptive sampling ᵘ"] * ("uniform" in used)
    page = TEXT.format(size=options.size, spp=options.spp[-1], least=options.spp[0], table=table(found), ways=table_of_ways(found),
                       peers="\n".join(wrapped(PEERS[p].format(version=version)) for p in PEERS if p in options.peers),
                       details=details(found), marks="Marked: " + ", ".join(marks) + "." if marks else "",
                       verdict=wrapped(verdict(found["ratios"])), missing=wrapped(missing(options, found)), minutes=math.ceil(seconds / 60), **own)
    (folder / "why").mkdir(exist_ok=True)
    (folder / "why/speed.md").write_text(page)
