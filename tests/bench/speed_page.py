# SPDX-License-Identifier: Apache-2.0
"""What speed.py measured as docs/speed.md and two plots."""
import math

COLOURS = {"vitrail": "#1b6f8a", "llvm_ad_spectral": "#d1762c", "scalar_spectral": "#8f8f8f"}
LABELS = {"vitrail": "Vitrail", "llvm_ad_spectral": "Mitsuba, llvm_ad_spectral", "scalar_spectral": "Mitsuba, scalar_spectral"}

TEXT = """# Speed

Written by `tests/bench/speed.py` from what it measured: the numbers are of one sitting, on one machine; ratios are what to read.

## To a given error, beside Mitsuba {version}

One thread each, start-up left out, pictures of {size} × {size} pixels. A renderer's *noise* is the relative mean square error between two
seeds, so that differences of models do not count; its *time* is that of the processor. Noise falls as 1/time, or faster, so that
time × noise measures a renderer; the table has that of Mitsuba over that of Vitrail, at {spp} samples a pixel: **above 1, Vitrail is
sooner at the same error; below, Mitsuba is**. `llvm_ad_spectral` traces whole pictures as streams of lanes, `scalar_spectral` a path at
a time. Scenes of Mitsuba's format are one file to both; those of PBRT are handed over by `vitrail convert`.

{table}

{verdict}

![ratios](images/speed-ratios.svg)

Each panel is one scene: noise against nanoseconds a pixel, from {least} to {spp} samples a pixel.

![noise against time](images/speed-noise.svg)

### What else one may choose

The same comparison, of path tracing by Mitsuba, where a scene asks for something else than path tracing with the usual samples:
`--integrator photon --photons N` with a photon a pixel and iteration for light that glass and white walls gather, `--splat` where the scene's
filter is wider than a pixel. Photons have a bias, so what counts of them is no noise: it is the error to 4096 paths a pixel of Mitsuba, less the noise of those. The
last row has the better of the two for each scene.

{ways}

What to know of the rows:

- *hotel room*: Mitsuba's path tracer cannot connect through the panes to the sun, so its picture lacks the sunlight in the room (the
  means show it) and what makes ours noisy. The two do not solve the same problem there.
- Its pixel filter is a Gaussian, too: Mitsuba adds each sample to several pixels, as Vitrail does with `--splat`; else that chooses the sample's place by the filter. The
  first makes neighbouring pixels alike, which this measure counts as less noise.
- *killeroo-simple*: Mitsuba gets what `vitrail convert` writes of the lamps, spheres of PBRT.
- Means that differ by more than the noise are said in the table: a model is then not the same, and its row says less.

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
tests/bench/speed.py --bin build/release/bin               # {minutes:.0f} minutes where others compute too; writes this page
```
"""


def table(results, ratios):
    lines = ["| | llvm_ad_spectral | scalar_spectral | ns a sample: Vitrail · llvm · scalar | noise: Vitrail · llvm · scalar | means |",
             "|---|---|---|---|---|---|"]
    for name, result in results.items():
        last = [rows[-1] for rows in result["rows"].values()]
        each = lambda values: " · ".join(values)
        mean = last[0]["mean"]
        apart = max(abs(row["mean"] / mean - 1) for row in last)
        peers = [f"**{ratios[p][name]:.2f}**" if ratios[p][name] < 1 else f"{ratios[p][name]:.2f}" for p in ratios]
        lines.append(f"| {name} | {' | '.join(peers)} | "
                     + each(f"{1e9 * row['seconds'] / result['pixels'] / row['spp']:.0f}" for row in last) + " | "
                     + each(f"{row['noise']:.2g}" for row in last) + f" | within {100 * apart:.1f} % |")
    means = " | ".join(f"{math.prod(r.values()) ** (1 / len(r)):.2f}" for r in ratios.values())
    return "\n".join(lines + [f"| geometric mean | {means} | | | |"])


def table_of_ways(results, ratios, by_ways):
    bold = lambda r: f"**{r:.2f}**" if r < 1 else f"{r:.2f}"
    lines = ["| | llvm_ad_spectral | scalar_spectral | ns a sample | noise | error | mean ÷ that of paths |", "|---|---|---|---|---|---|---|"]
    for name, result in results.items():
        paths = result["rows"]["vitrail"][-1]
        for way, row in result["ways"].items():
            err = f"{row['error']:.2g}" if "error" in row else ""
            lines.append(f"| {name}, {way} | {' | '.join(bold(of[name, way]) for of in by_ways.values())} | "
                         f"{1e9 * row['seconds'] / result['pixels'] / paths['spp']:.0f} | {row['noise']:.2g} | {err} | "
                         f"{row['mean'] / paths['mean']:.4f} |")
    best = [math.prod(max([r, *(v for (n, _), v in by_ways[p].items() if n == name)]) for name, r in of.items()) ** (1 / len(of))
            for p, of in ratios.items()]
    return "\n".join(lines + [f"| geometric mean of all scenes | {' | '.join(f'{b:.2f}' for b in best)} | | | | |"])


def verdict(ratios):
    lost = {p: [name for name, r in of.items() if r < 1] for p, of in ratios.items()}
    say = lambda p: f"to `{p}` on " + ("; ".join(lost[p]) if lost[p] else "none")
    return f"Bold: lost. Of {len(next(iter(ratios.values())))} scenes Vitrail loses " + ", and ".join(say(p) for p in ratios) + "."


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
    names = list(next(iter(ratios.values())))
    values = [r for of in ratios.values() for r in of.values()]
    low, high = min(.5, *values) / 1.15, max(2, *values) * 1.25
    left, width, row = 170, 480, 34
    x = lambda r: left + width * math.log(r / low) / math.log(high / low)
    bottom = 40 + row * len(names)
    parts = legend(ratios, 18)
    for tick in (.1, .2, .5, 1, 2, 5, 10):
        if low < tick < high:
            parts += [f'<line x1="{x(tick):.1f}" y1="32" x2="{x(tick):.1f}" y2="{bottom}" stroke="{"#000" if tick == 1 else "#ddd"}"/>',
                      text(x(tick), bottom + 14, f"{tick}×", "middle")]
    for i, name in enumerate(names):
        y = 40 + row * i
        parts.append(text(left - 8, y + 16, name, "end"))
        for k, (p, of) in enumerate(ratios.items()):
            a, b = sorted((x(1), x(of[name])))
            top = y + 2 + 13 * k
            parts += [f'<rect x="{a:.1f}" y="{top}" width="{b - a:.1f}" height="11" fill="{COLOURS[p]}"/>',
                      text(x(of[name]) + (4 if of[name] > 1 else -4), top + 9, f"{of[name]:.2f}", "start" if of[name] > 1 else "end")]
    parts += [text(x(1) + 6, bottom + 30, "Vitrail is sooner →"), text(x(1) - 6, bottom + 30, "← Mitsuba is sooner", "end")]
    return svg(left + width + 40, bottom + 40, parts)


def panel(name, result, left, top, side=190):
    """Noise against time of the renderers on one scene; both axes logarithmic, decades marked."""
    points = {r: [(1e9 * row["seconds"] / result["pixels"], row["noise"]) for row in rows] for r, rows in result["rows"].items()}
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


def noise_plot(results, columns=4):
    parts = legend(COLOURS, 18)
    for i, (name, result) in enumerate(results.items()):
        parts += panel(name, result, 50 + 240 * (i % columns), 50 + 240 * (i // columns))
    return svg(240 * columns + 20, 50 + 240 * math.ceil(len(results) / columns), parts)


def write_page(folder, options, results, ratios, by_ways, own, seconds, version):
    (folder / "images").mkdir(parents=True, exist_ok=True)
    (folder / "images/speed-ratios.svg").write_text(ratios_plot(ratios))
    (folder / "images/speed-noise.svg").write_text(noise_plot(results))
    page = TEXT.format(version=version, size=options.size, spp=options.spp[-1], least=options.spp[0], table=table(results, ratios), ways=table_of_ways(results, ratios, by_ways),
                       verdict=verdict(ratios), minutes=math.ceil(seconds / 60), **own)
    (folder / "speed.md").write_text(page)
