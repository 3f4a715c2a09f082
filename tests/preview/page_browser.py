#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of weft preview and weft compare in a real browser:  page_browser.py WEFT [FOLDER FOR SCREENSHOTS]

The network is cut. Status 77: skipped, no chromium (Debian: apt-get install --no-install-recommends chromium).
"""
import json
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import Browser, colours, find_chromium

if not find_chromium():
    print("SKIPPED: no chromium; apt-get install --no-install-recommends chromium", file=sys.stderr)
    sys.exit(77)
weft, shots = os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None
root = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
scratch = tempfile.TemporaryDirectory()
failures = 0


def expect(name, condition, said=""):
    global failures
    print(("ok: " if condition else "FAILED: ") + name + ("" if condition else f": {said}"), flush=True)
    failures += not condition


def run(*words, status=0):
    done = subprocess.run([weft, *words], cwd=scratch.name, capture_output=True, text=True)
    expect("weft " + " ".join(words[:3]), done.returncode == status, f"status {done.returncode}: {done.stderr}")
    return done


def place(name):
    return os.path.join(scratch.name, name)


def facts_of(page):
    text = open(place(page), encoding="utf-8").read()
    return json.loads(re.search(r'id="facts">(.*?)</script>', text, re.S).group(1))


def near(counted, css, tolerance=28):
    """Pixels of about that hue: a lit bead is lighter or darker than its colour, in the same proportions."""
    want = [int(css[i:i + 2], 16) for i in (1, 3, 5)]
    total = 0
    for rgb, count in counted.items():
        scale = sum(rgb) / max(1, sum(want))
        if 0.45 < scale < 1.25 and all(abs(v - w * scale) <= tolerance * scale for v, w in zip(rgb, want)):
            total += count
    return total


def quiet(browser, name):
    expect(f"{name}: the console is silent", not browser.errors, browser.errors[:3])
    browser.errors.clear()
    asked = [url for url in browser.requests if not url.startswith(("file:", "data:", "about:", "blob:"))]
    expect(f"{name}: nothing is asked of the network", not asked, asked[:3])


def shot(browser, name):
    return browser.shot(os.path.join(shots, name) if shots else None)


bracket = os.path.join(root, "examples", "bracket.stl")
run("slice", bracket, "--layer-height", "0.3", "-q", "-o", "part.gcode", "--report", "part.json", "--preview", "part.html")
run("slice", bracket, "--layer-height", "0.3", "--speed-wall-0", "20", "-q", "-o", "slow.gcode")
hostile = '</script><script>document.body.dataset.broken=1</script>"\'\u202e'
with open(place("part.gcode"), encoding="utf-8") as f:
    text = f.read()
with open(place("hostile.gcode"), "w", encoding="utf-8") as f:
    f.write(text.replace(";TYPE:Perimeter", ";TYPE:" + hostile) + ";" + "x" * 1_000_000 + "\n;TYPE:</title><img src=x onerror=alert(1)>\nG1 X1 E1\n")
with open(place("outside.gcode"), "w", encoding="utf-8") as f:
    f.write(text.replace(";LAYER_CHANGE", "G1 X-300 Y10 F6000\n;LAYER_CHANGE", 6))
run("preview", "hostile.gcode", "-o", hostile.replace("/", "_") + ".html")
os.rename(place(hostile.replace("/", "_") + ".html"), place("hostile.html"))
run("preview", "outside.gcode", "--audit", "-s", "machine_width=220", "-o", "outside.html")
run("compare", "part.gcode", "slow.gcode", "-o", "both.html", status=8)
report, facts = json.load(open(place("part.json"))), facts_of("part.html")

browser = Browser()
try:
    browser.open(place("part.html"))
    data = browser.js("({...document.body.dataset})")
    expect("the page is ready", data.get("ready") == "1" and "error" not in data, data)
    expect("solids are drawn", data.get("painter") == "solid", data.get("painter"))
    counts, print0 = json.loads(data["counts"]), facts["prints"][0]
    expect("as many beads as the reader has counted", counts["beads"] == [print0["figures"]["beads"]], counts)
    expect("as many layers as the report says", counts["layers"] == [report["layers"]], counts)
    expect("as many retractions as the report says", abs(counts["retractions"][0] - report["travel"]["retractions"]) <= 1, counts)
    expect("moves take the time of the layers", abs(counts["seconds"][0] - print0["figures"]["seconds"]) < 0.5, counts)
    expect("and about the time of the report", abs(print0["figures"]["seconds"] / report["print_time_s"] - 1) < 0.15, (print0["figures"]["seconds"], report["print_time_s"]))
    expect("as much filament as the report says", abs(print0["figures"]["filamentMm"] / report["filament"]["mm"] - 1) < 0.02, print0["figures"]["filamentMm"])
    browser.js("look('iso')"); browser.rest()
    counted = colours(shot(browser, "feature.png"))
    for feature in print0["features"]:
        if feature["key"] in ("outer_wall", "top_skin"):
            expect(f"the colour of {feature['name']} is seen", near(counted, feature["colour"]) > 300, near(counted, feature["colour"]))
    wall = next(f for f in print0["features"] if f["key"] == "outer_wall")
    before = near(counted, wall["colour"])
    browser.js("document.querySelectorAll('#legend input').forEach(i=>{if(i.parentNode.innerText.includes('outer wall'))i.click()})"); browser.rest()
    expect("a feature that is switched off is gone", near(colours(browser.shot()), wall["colour"]) < before / 3)
    browser.js("state.hidden.clear();repaint();change()")

    for colour in ("width", "speed", "flow", "layer time", "support", "fan", "temperature", "height"):
        browser.js(f"$('colour').value={json.dumps(colour)};$('colour').onchange()"); browser.rest()
        expect(f"coloured by {colour}", browser.js("document.body.dataset.colour") == colour and browser.js("$('legend').children.length") >= 1)
    browser.js("$('colour').value='speed';$('colour').onchange()"); browser.rest()
    least, most = map(float, browser.js("document.body.dataset.range").split())
    expect("speeds are those of the file", most <= 300 and least < most, (least, most))
    shot(browser, "speed.png")
    browser.js("$('colour').value='feature';$('colour').onchange()")

    # Sliders and keys.
    layers = report["layers"]
    browser.js("$('top').value=5;$('top').oninput()"); browser.rest()
    expect("the slider of layers says where it is", browser.js("$('top-says').textContent").startswith(f"6 of {layers}"), browser.js("$('top-says').textContent"))
    low = near(colours(browser.shot()), wall["colour"])
    expect("below a layer there is less to see", 0 < low < before, (low, before))
    browser.js("$('time').value=5000;$('time').oninput()"); browser.rest()
    said = browser.js("lastSeconds()/prints[0].figures.seconds")
    expect("half of the time is half of the way", abs(said - 0.5) < 0.03, said)
    browser.js("$('top').value=$('top').max;$('top').oninput();$('picture').focus()")
    for key, code, shift, check in (("ArrowLeft", "", False, "camera.yaw"), ("ArrowUp", "", False, "camera.pitch"), ("ArrowLeft", "", True, "camera.target.join()"), ("+", "Equal", False, "camera.zoom"),
                                    ("PageDown", "", False, "$('top').value"), (",", "Comma", False, "$('moves').value"), ("c", "KeyC", False, "state.colour"), ("t", "KeyT", False, "checked('travels')"),
                                    ("r", "KeyR", False, "checked('retractions')"), ("s", "KeyS", False, "checked('seams')"), ("m", "KeyM", False, "checked('model')"), ("2", "Digit2", False, "camera.pitch")):
        was = browser.js(check)
        browser.key(key, code, shift)
        expect(f"key {key}{' with Shift' if shift else ''} changes {check}", browser.js(check) != was, was)
    shot(browser, "everything.png")
    yaw = browser.js("camera.yaw")
    browser.drag(400, 400, 460, 430)
    expect("dragging turns", browser.js("camera.yaw") != yaw)
    browser.js("for (const id of ['travels','retractions','seams','model']) $(id).checked=false;$('colour').value='feature';$('colour').onchange();$('top').value=$('top').max;chooseLayer();look('iso')"); browser.rest()
    whole = colours(browser.shot())
    browser.js("$('cut').value='x';$('cut-at').value=500;$('cut').onchange()"); browser.rest()
    cut = colours(shot(browser, "cut.png"))
    inner = [f for f in print0["features"] if f["key"] in ("infill", "skin", "solid_infill")]
    expect("cut open, what is inside is seen", any(near(cut, f["colour"]) > 1.2 * near(whole, f["colour"]) + 50 for f in inner))
    browser.js("$('cut').value='';$('cut').onchange()")
    expect("every control has a name", browser.js("[...document.querySelectorAll('input,select,button')].every(e=>e.labels?.length||e.getAttribute('aria-label')||e.textContent.trim())"))
    expect("sliders speak", browser.js("$('top').getAttribute('aria-valuetext')").startswith(str(layers)))
    expect("what is shown is told", "line" in browser.js("$('readout').textContent"))
    browser.js("document.querySelectorAll('details').forEach(d=>d.open=true)")
    expect("figures are drawn", browser.js("document.querySelectorAll('#plots svg').length") == 5)
    quiet(browser, "a print")

    browser.media(prefers_color_scheme="dark", prefers_reduced_motion="reduce")
    browser.open(place("outside.html"))
    expect("six findings are listed", browser.js("document.querySelectorAll('#findings button').length") >= 6, browser.js("document.querySelectorAll('#findings button').length"))
    paper = colours(browser.shot()).most_common(1)[0][0]
    expect("dark where that is asked for", sum(paper) < 150, paper)
    browser.key("f", "KeyF"); browser.rest()
    expect("f flies to a finding", browser.js("document.body.dataset.finding") == "0" and abs(browser.js("camera.target[0]-offOrigin(findings[0].at)[0]")) < 0.01)
    counted = colours(shot(browser, "finding.png"))
    expect("it is marked", near(counted, facts["colours"]["outside"], 12) + counted.get((255, 255, 51), 0) > 40)
    quiet(browser, "findings")
    browser.media(prefers_color_scheme="light", prefers_reduced_motion="no-preference")

    browser.size(390, 800, mobile=True)
    browser.open(place("part.html"))
    expect("nothing is wider than a phone", browser.js("document.documentElement.scrollWidth") <= 390, browser.js("document.documentElement.scrollWidth"))
    expect("the picture has room there", browser.js("$('picture').clientHeight") >= 240)
    shot(browser, "phone.png")
    browser.size(1280, 900)
    quiet(browser, "a phone")

    browser.open(place("hostile.html"))
    expect("names and comments of a file do not run", not browser.js("document.body.dataset.broken||document.querySelector('img')"))
    expect("and are shown", "script" in browser.js("document.body.innerText"))
    quiet(browser, "hostile names")

    browser.open(place("both.html"))
    comparison = facts_of("both.html")["comparison"]
    expect("two prints stand side by side", json.loads(browser.js("document.body.dataset.counts"))["layers"] == [layers, layers])
    shot(browser, "side.png")
    browser.js("$('layout').value='over';$('layout').onchange()"); browser.rest()
    shot(browser, "over.png")
    expect("differences are told", browser.js("$('differences').innerText").count("\n") > 10 and comparison["settings"], comparison["settings"])
    quiet(browser, "two prints")
finally:
    browser.close()

flat = Browser(gl=False)
try:
    flat.open(place("part.html"))
    expect("without WebGL2 there is a flat page", flat.js("document.body.dataset.painter") == "flat", flat.js("document.body.dataset.painter"))
    flat.js("$('top').value=5;$('top').oninput()"); flat.rest()
    counted = colours(shot(flat, "flat.png"))
    expect("with walls on it", near(counted, wall["colour"]) > 300)
    flat.errors = [e for e in flat.errors if "WebGL" not in e]  # that it cannot is what the browser says, not the page
    quiet(flat, "flat")
finally:
    flat.close()
sys.exit(failures > 0)
