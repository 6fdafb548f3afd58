# SPDX-License-Identifier: Apache-2.0
"""What speed.py measured as docs/why/speed.md and two plots."""
import math
import textwrap

COLOURS = {"vitrail": "#1b6f8a", "llvm_ad_spectral": "#d1762c", "llvm_ad_rgb": "#b8a12c", "scalar_spectral": "#8f8f8f", "cycles": "#5b8c3a", "pbrt": "#8a4f9e"}
LABELS = {"vitrail": "Vitrail", "llvm_ad_spectral": "Mitsuba, llvm_ad_spectral", "scalar_spectral": "Mitsuba, scalar_spectral",
          "llvm_ad_rgb": "Mitsuba, llvm_ad_rgb", "cycles": "Cycles", "pbrt": "pbrt-v4"}
COLUMNS = LABELS | {"llvm_ad_spectral": "Mitsuba, llvm", "llvm_ad_rgb": "Mitsuba, llvm, RGB", "scalar_spectral": "Mitsuba, scalar"}

TEXT = """# Speed

`tests/bench/speed.py` measured these numbers in one run on one machine, and wrote this page. Compare ratios.

## To a given error, beside each peer's best

One thread each, start-up left out, pictures of {size} × {size} pixels. A renderer's *noise* is the relative mean
square error between two seeds, so differences of models do not count. Its *time* is processor time. Noise falls as
1/time, or faster, so time × noise measures a renderer.

The table has time × noise of the peer over that of Vitrail with its defaults, at {spp} samples a pixel. **Above 1,
Vitrail is sooner at the same error; below, the peer is.** The last column has Vitrail's nanoseconds a sample · noise.

{peers}

{table}

{verdict}

{missing}

![ratios](../images/speed-ratios.svg)

Each panel is one scene: noise against nanoseconds a pixel, from {least} to {spp} samples a pixel.

![noise against time](../images/speed-noise.svg)

### Other ways to sample

Some scenes gain from another way than path tracing with the usual samples; the peers stay at path tracing. Photons
(`--integrator photon`) have a bias, so their *error* to 4096 paths a pixel of Mitsuba counts in place of noise.
[Better samples](sampling.md) has the other ways. The table has the best way of each scene, if it gains a tenth. The mean is over
all scenes.

{ways}

Notes on the rows:

- *hotel room*, *city*: Mitsuba's path tracer cannot connect through panes to the sun. Its picture lacks the sunlight
  in the rooms (the means show it), and with it most of our noise. The two do not solve the same problem there.
- The pixel filters of these two and of *Cornell of Tungsten* are wider than a pixel. Mitsuba adds each sample to
  several pixels, as Vitrail does with `--splat`. Neighbouring pixels are then alike, which counts as less noise here.
- Where the means differ by more than the noise, the models differ, and the row says less.
- Cycles computes in RGB and gets spheres as meshes. Its lamps let light through, so its means are 1 % higher.

## Where the time goes

`tests/bench/stages.py` measured shares of processor time (AVX-512, 64 samples, start-up included). Intersection takes
20 to 41 % in small scenes, 51 % in killeroo-simple, 56 % in the city and 66 % in the hotel room. Shading, which is
BSDFs and lights, takes 22 to 55 %, the film 1 to 20 %. All that a sample costs before its first ray takes 33 % in
*various shapes*, 1 to 18 % elsewhere.

Vitrail loses to `llvm_ad_spectral` for these reasons:

- *Doubles.* Shading takes 8 doubles in a register of AVX-512, Mitsuba 16 floats. The film is one bit pattern for any
  division of the work, and decisions near an edge need doubles ([waves](waves.md)).
- *Trees.* In trees of more than one node rays go one by one, with eight boxes or triangles as lanes. The processor
  guesses the next branch wrongly. `llvm_ad_spectral` gives Embree many rays at once, which share these guesses.
- *Two sequences* cost 0 to 20 % of the noise, and no cheaper estimate of the error was found
  ([better samples](sampling.md#halves-of-one-sequence-as-groups)).
- *The beginning of a sample* is a third of the time where paths end at once. Over a third of that is four wavelengths
  and what the sensor makes of them ([better samples](sampling.md#costs-that-stay)).

To pass, hotel room and city need rays that share the way through big trees. Scenes of shading need 16 floats where no
bit of the film hangs on it.

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
    lines = [f"| | {' | '.join(COLUMNS[p] for p in ratios)} | means | Vitrail |", "|---" * (len(ratios) + 3) + "|"]
    for name, result in found["results"].items():
        means = [rows[-1]["mean"] for rows in rows_of(result, found["best"][name]).values()]
        apart = max(abs(mean / means[0] - 1) for mean in means)
        own = result["rows"]["vitrail", ""][-1]
        lines.append(f"| {name} | {' | '.join(bold(of[name]) if name in of else '—' for of in ratios.values())} | "
                     f"within {100 * apart:.1f} % | {ns_of(own, result)} · {own['noise']:.2g} |")
    return "\n".join([*lines, f"| geometric mean | {' | '.join(mean_of(list(of.values())) for of in ratios.values())} | | |"])


def table_of_ways(found):
    results, ratios, by_ways = found["results"], found["ratios"], found["by_ways"]
    lines = [f"| | {' | '.join(COLUMNS[p] for p in ratios)} | mean ÷ that of paths |", "|---" * (len(ratios) + 2) + "|"]
    for name, result in results.items():
        paths = result["rows"]["vitrail", ""][-1]
        gains = {way: max((of[name, way] / ratios[p][name] for p, of in by_ways.items() if (name, way) in of), default=0) for way in result["ways"]}
        for way, row in result["ways"].items():
            if gains[way] < max(1.1, *gains.values()):
                continue
            each = " | ".join(bold(of[name, way]) if (name, way) in of else "—" for of in by_ways.values())
            lines.append(f"| {name}, {way} | {each} | {row['mean'] / paths['mean']:.4f} |")
    better = [mean_of([max([r, *(v for (n, _), v in by_ways[p].items() if n == name)]) for name, r in of.items()])
              for p, of in ratios.items()]
    return "\n".join([*lines, f"| geometric mean of all scenes | {' | '.join(better)} | |"])


def verdict(ratios):
    words = [f"to {LABELS[p]} on {sum(r < 1 for r in of.values())} of {len(of)}" for p, of in ratios.items()]
    return "Bold: lost. Vitrail loses " + "; ".join(words) + "."


PEERS = {
    "llvm_ad_spectral": "- *Mitsuba {version}*: `llvm_ad_spectral` traces whole pictures as streams of lanes, `scalar_spectral` a path at a time. Each has "
                        "the sampler of the scene and `multijitter`; the better one counts. It gets scenes of PBRT by `vitrail convert`.",
    "cycles": "- *Cycles*, of Blender's `bpy`: on its CPU device, with its default sampler and light tree, adaptive sampling on or off; the better one "
              "counts. Denoiser, clamps and the blur of caustics are off.",
    "pbrt": "- *pbrt-v4*, with `zsobol`, its default. All scenes are handed over by `vitrail convert`.",
}


def missing(options, found):
    words = [f"{LABELS[p]} is left out: {why}." for p, why in options.missing.items()]
    refused = dict.fromkeys((p, why) for result in found["results"].values() for p, why in result["refused"].items())
    words += [f"A dash of {LABELS[p]}: {why}." for p, why in refused]
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
    page = TEXT.format(size=options.size, spp=options.spp[-1], least=options.spp[0], table=table(found), ways=table_of_ways(found),
                       peers="\n".join(wrapped(PEERS[p].format(version=version)) for p in PEERS if p in options.peers),
                       verdict=wrapped(verdict(found["ratios"])), missing=wrapped(missing(options, found)), minutes=math.ceil(seconds / 60), **own)
    (folder / "why").mkdir(exist_ok=True)
    (folder / "why/speed.md").write_text(page)
