#!/usr/bin/env python3
"""Pages of all five commands in headless Chromium: browser.py DRIFTSCOPE [KEEP]

Each page is made by the program from a small study and looked at 1400, 600 and 400 px wide, light and
dark, and printed:
  - nothing is wider than the window, but for tables, which scroll; no picture needs to
  - no text of a figure is smaller than 12 px (8 at 400 px, 7 pt on paper), lies outside its picture, or
    over another text of it; no table is wider than its sheet
  - a dark page is dark and its text light
  - with its details folded it prints on at most four pages; how high it is, is told
  - a figure that can be zoomed is drawn by the script of the page itself, with no error in it, and
    without script the static picture is there
KEEP: a new folder for the pages and their pictures, to be looked at. Skipped (77) without Chromium.
"""
import base64
import hashlib
import html as html_text
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

WIDTHS = {1400: 12.0, 600: 12.0, 400: 8.0}  # and the smallest text of a figure there [px]
MODES = {"light": "1", "dark": "0"}  # Chromium's preferredColorScheme
MOST_PAGES = 4
SHEET, SIDEWAYS = 703, 1032  # [px] of A4 within its margins of 12 mm
PRINTED_TEXT = 7.0 * 96 / 72  # [px] of 7 pt

# What is measured in the page; the result is left in the body as text.
MEASURE = """
const close = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left);
const over = (a, b) => Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
function light(colour) {
  const [r, g, b] = colour.match(/[\\d.]+/g).map(Number);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
function measure() {
  const out = {width: innerWidth, page: document.documentElement.scrollWidth,
               height: document.documentElement.scrollHeight, smallest: 1e9, texts: 0,
               outside: [], crossed: [], scrolled: [], figures: 0, tables: [], errors: window.failed};
  for (const table of document.querySelectorAll('table')) {
    const most = table.closest('.wide') ? %SIDEWAYS% : %SHEET%, wide = table.getBoundingClientRect().width;
    if (wide > most + 1) out.tables.push(wide.toFixed(0) + ' px: ' + table.textContent.trim().slice(0, 40));
  }
  for (const svg of document.querySelectorAll('figure .scroll > svg, figure .head > svg')) {
    if (!svg.getClientRects().length) continue;  // drawn for another width
    ++out.figures;
    const place = svg.parentElement;
    if (place.scrollWidth > place.clientWidth + 1) out.scrolled.push(svg.textContent.trim().slice(0, 40));
    const frame = svg.getBoundingClientRect(), boxes = [], name = ' in ' + (svg.querySelector('title')?.textContent || '').slice(0, 40);
    for (const text of svg.querySelectorAll('text')) {
      if (!text.textContent.trim()) continue;
      ++out.texts;
      const m = text.getScreenCTM(), scale = Math.hypot(m.a, m.b);
      out.smallest = Math.min(out.smallest, parseFloat(getComputedStyle(text).fontSize) * scale);
      const box = text.getBoundingClientRect(), said = text.textContent.slice(0, 40) + name;
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 ||
          box.bottom > frame.bottom + 1) out.outside.push(said);
      for (const [other, what] of boxes)
        if (close(box, other) > 2 && over(box, other) > 4) out.crossed.push(what + ' | ' + said);
      boxes.push([box, said]);
    }
  }
  const style = getComputedStyle(document.body);
  out.paper = light(style.backgroundColor);
  out.ink = light(style.color);
  out.zoomable = document.querySelectorAll('figure.zoomable').length;
  for (const button of document.querySelectorAll('figure.zoomable button')) button.click();
  setTimeout(() => leave(zoomed(out)), 300);
}
function zoomed(out) {
  out.zoomed = out.replaced = 0;
  for (const figure of document.querySelectorAll('figure.zoomable')) {
    const inked = [...figure.querySelectorAll('canvas')].some(canvas => {
      const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      return data.some((value, i) => i % 4 === 3 && value > 0);
    });
    out.zoomed += inked ? 1 : 0;
    out.replaced += figure.querySelector('svg').getClientRects().length ? 0 : 1;
  }
  out.page = Math.max(out.page, document.documentElement.scrollWidth);
  return out;
}
function leave(out) {
  document.documentElement.innerHTML = '<body><pre id="measured"></pre></body>';
  document.getElementById('measured').textContent = JSON.stringify(out);
}
""".replace("%SHEET%", str(SHEET)).replace("%SIDEWAYS%", str(SIDEWAYS))

STUDY = """schema = 1
title  = "browser test"
[site]
latitude = "45.75 deg"
[plan]
preset = "twelve"
dwell  = "20 min"
sample = "60 s"
mode   = "free"
[truth]
coupling = "eq5"
[[filter]]
name     = "eq6"
coupling = "eq6"
starts   = 2
[[filter]]
name     = "eq5"
coupling = "eq5"
starts   = 2
[monte_carlo]
runs = 20
seed = 3
"""
SWEEP = '[sweep]\n"truth.coupling" = ["eq5", "eq6"]\n"plan.dwell" = ["10 min", "20 min"]\n'


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def make_pages(program, folder):
    """Name of the command: its page."""
    study, sweep = folder / "study.toml", folder / "sweep.toml"
    blind = pathlib.Path(__file__).parent.parent / "configs" / "blind_small.toml"
    study.write_text(STUDY)
    sweep.write_text(STUDY + SWEEP)
    run(program, "simulate", study, "-o", folder / "recording.csv")
    run(program, "identify", study, "-o", folder / "identify")
    run(program, "rank", study, "--improve", "1", "-o", folder / "rank")
    run(program, "diagnose", study, folder / "recording.csv", "-o", folder / "diagnose")
    run(program, "run", sweep, "-o", folder / "run", "--progress", "none")
    run(program, "blind", blind, "--trials", "6", "-o", folder / "blind", "--progress", "none")
    return {name: folder / name / "report.html" for name in ("identify", "rank", "diagnose", "run", "blind")}


def chromium(browser, *arguments):
    profile = tempfile.mkdtemp()
    try:
        return run(browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                   f"--user-data-dir={profile}", *arguments, timeout=300)
    finally:
        shutil.rmtree(profile, ignore_errors=True)


def with_script(page, opened):
    """A page that measures itself: its own policy lets no foreign script in."""
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    head = "<script>window.failed = []; addEventListener('error', e => failed.push(e.message));</script>"
    page = page.replace("<head>", "<head>" + head, 1)
    if opened:
        page = page.replace("<details>", "<details open>")
    tail = f"<script>{MEASURE}\naddEventListener('load', () => setTimeout(measure, 300));</script>"
    return page.replace("</body>", tail + "</body>")


def measured(browser, page, width, mode, folder, opened=True):
    """In a frame of the very width: a window may not be that narrow."""
    inner, outer = folder / "inner.html", folder / "outer.html"
    inner.write_text(with_script(page, opened))
    outer.write_text(
        f'<!DOCTYPE html><body style="margin:0"><iframe id="frame" src="inner.html" '
        f'style="width:{width}px;height:900px;border:0"></iframe><script>setInterval(() => {{'
        "const e = frame.contentDocument && frame.contentDocument.getElementById('measured');"
        "if (e) document.body.innerHTML = '<pre>' + e.innerHTML + '</pre>'; }, 50);</script></body>")
    dom = chromium(browser, "--allow-file-access-from-files", f"--window-size={width + 100},1000",
                   f"--blink-settings=preferredColorScheme={MODES[mode]}", "--virtual-time-budget=20000",
                   "--dump-dom", outer.as_uri())
    found = re.search(r"<pre>(\{.*\})</pre>", dom, re.S)
    if not found:
        sys.exit(f"nothing was measured at {width} px, {mode}: {dom[:500]}")
    return json.loads(html_text.unescape(found.group(1)))


def printed_pages(browser, page, folder):
    pdf = folder / "printed.pdf"
    chromium(browser, "--no-pdf-header-footer", f"--print-to-pdf={pdf}", page.as_uri())
    return len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes()))


def as_on_paper(page):
    """A page that shows in a window what paper has, where nothing is zoomed: no script can measure a printed page."""
    page = page.replace('<figure class="zoomable">', "<figure>")
    return page.replace("@media screen", "@media !").replace("@media print", "@media screen").replace("@media !", "@media print")


def complaints_of_policy(page):
    """The script of a page is the one its policy names, or browsers do not run it."""
    scripts = re.findall(r"<script>(.*?)</script>", page, re.S)
    named = re.findall(r"script-src 'sha256-([^']*)'", page)
    hashes = [base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in scripts]
    if hashes != named:
        yield f"scripts {hashes}, allowed {named}"
    if '<figure class="zoomable"' in page and not scripts:
        yield "figures to zoom and no script"


def complaints_of_figures(m, smallest):
    if m["texts"] == 0:
        yield "no figure has any text"
    if m["smallest"] < smallest - 0.01:
        yield f"text of {m['smallest']:.1f} px in a figure (expected at least {smallest:.1f})"
    for what, said in (("texts outside its figure", m["outside"]), ("texts over another", m["crossed"]),
                       ("pictures wider than their place", m["scrolled"])):
        if said:
            yield f"{len(said)} {what}, as {said[:3]}"


def complaints_of_paper(m):
    yield from complaints_of_figures(m, PRINTED_TEXT)
    if m["tables"]:
        yield f"{len(m['tables'])} tables wider than a sheet, as {m['tables'][:3]}"


def complaints_of(m, width, mode):
    if m["width"] != width:
        yield f"the window is {m['width']} px wide"
    if m["page"] > width:
        yield f"the page is {m['page']} px wide"
    yield from complaints_of_figures(m, WIDTHS[width])
    if (m["paper"] < m["ink"]) != (mode == "dark"):
        yield f"paper of {m['paper']:.0f}, ink of {m['ink']:.0f}"
    if m["errors"]:
        yield f"errors in its script: {m['errors'][:3]}"
    if not m["zoomable"] == m["zoomed"] == m["replaced"]:
        yield f"{m['zoomable']} figures can be zoomed, {m['zoomed']} are drawn in place of {m['replaced']} pictures"


def check_the_check(browser, page, folder):
    """A page spoilt in every way is complained of in every way."""
    spoilt = page.replace("</svg>", '<text x="20" y="40" font-size="9">small</text><text x="20" y="42" '
                          'font-size="9">over it</text><text x="-90" y="40">outside</text></svg>', 1)
    spoilt = spoilt.replace("<h2>", '<figure><div class="scroll"><svg width="3000" height="20"><text x="5" '
                            'y="15">too wide</text></svg></div></figure><h2>', 1)
    spoilt = spoilt.replace("<h2>", '<div style="width: 3000px">wide</div><h2>', 1).replace("var(--paper)", "#000")
    said = " ".join(complaints_of(measured(browser, spoilt, 1400, "light", folder), 1400, "light"))
    for what in ("the page is 3", "text of 9.0 px", "texts outside", "texts over another", "pictures wider", "paper of"):
        if what not in said:
            yield f"the check itself: '{what}' is missing in: {said}"
    spoilt = page.replace("--drawn: 860", "--drawn: 400").replace("<table>", '<table style="width: 1200px">')
    said = " ".join(complaints_of_paper(measured(browser, as_on_paper(spoilt), SHEET, "light", folder)))
    for what in ("text of 4.4 px", "tables wider than a sheet"):
        if what not in said:
            yield f"the check itself, on paper: '{what}' is missing in: {said}"


def main():
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if browser is None:
        print("not compared: no Chromium on this machine (Debian package chromium)")
        return 77
    program = pathlib.Path(sys.argv[1]).resolve()
    keep = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    folder = keep or pathlib.Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    if any(folder.iterdir()):
        sys.exit(f"{folder}: is not empty (expected a new folder for the pages)")
    wrong = []
    try:
        pages_made = make_pages(program, folder)
        wrong += check_the_check(browser, pages_made["rank"].read_text(), folder)
        for name, path in pages_made.items():
            page = path.read_text()
            pages = printed_pages(browser, path, folder)
            high = measured(browser, page, max(WIDTHS), "light", folder, opened=False)["height"]
            printed = measured(browser, as_on_paper(page), SHEET, "light", folder)
            line = (f"{name}: {len(page) // 1000} kB, {pages} printed pages, text of a figure there from {printed['smallest'] * 72 / 96:.1f} pt, "
                    f"{high} px high at {max(WIDTHS)} px with its details folded")
            wrong += [f"{name}, on paper: {what}" for what in complaints_of_paper(printed)]
            if not 1 <= pages <= MOST_PAGES:
                wrong.append(f"{name}: {pages} printed pages (expected 1 to {MOST_PAGES})")
            wrong += [f"{name}: {what}" for what in complaints_of_policy(page)]
            for width in WIDTHS:
                for mode in MODES:
                    m = measured(browser, page, width, mode, folder)
                    wrong += [f"{name}, {width} px, {mode}: {what}" for what in complaints_of(m, width, mode)]
                    line += f"; {width} px {mode}: {m['figures']} figures, {m['zoomed']} zoomed, text from {m['smallest']:.1f} px"
                    if keep:
                        chromium(browser, f"--window-size={max(width, 500)},6000", f"--screenshot={keep}/{name}_{width}_{mode}.png",
                                 f"--blink-settings=preferredColorScheme={MODES[mode]}", path.as_uri())
            print(line, flush=True)
    finally:
        if keep is None:
            shutil.rmtree(folder, ignore_errors=True)
    for what in wrong:
        print("wrong:", what)
    return 1 if wrong else 0


if __name__ == "__main__":
    os.environ["LC_ALL"] = "C.UTF-8"
    sys.exit(main())
