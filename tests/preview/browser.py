# SPDX-License-Identifier: GPL-3.0-or-later
"""Chromium without a window, driven through a pipe (Chrome DevTools Protocol), its network cut; and pictures as pixels.

Needs nothing but Python's own library and a chromium. Whatever the page writes to its console, and whatever it throws,
is kept in `errors`.
"""
import base64
import collections
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib


def find_chromium():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            return path
    return None


class Browser:
    def __init__(self, width=1280, height=900, gl=True):
        self.folder = tempfile.mkdtemp()
        read_end, ours_out = os.pipe()
        ours_in, write_end = os.pipe()

        def adopt():
            os.dup2(read_end, 13)
            os.dup2(write_end, 14)
            os.dup2(13, 3)
            os.dup2(14, 4)

        words = [find_chromium(), "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe", "--no-first-run",
                 "--disable-background-networking", "--disable-extensions", "--hide-scrollbars", "--host-resolver-rules=MAP * ~NOTFOUND",
                 f"--user-data-dir={self.folder}", f"--window-size={width},{height}", "--force-device-scale-factor=1"]
        words += ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"] if gl else ["--disable-gpu", "--disable-3d-apis"]
        self.process = subprocess.Popen(words + ["about:blank"], preexec_fn=adopt, close_fds=False, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(read_end)
        os.close(write_end)
        self.out, self.inp, self.pending, self.number = ours_out, ours_in, b"", 0
        self.errors, self.requests = [], []
        target = next(t for t in self.call("Target.getTargets", session=False)["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", {"targetId": target["targetId"], "flatten": True}, session=False)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.call("Network.emulateNetworkConditions", {"offline": True, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1})
        self.size(width, height)

    def _message(self, seconds):
        until = time.monotonic() + seconds
        while b"\0" not in self.pending:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.inp], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            piece = os.read(self.inp, 1 << 20)
            if not piece:
                raise EOFError("the browser has ended")
            self.pending += piece
        text, _, self.pending = self.pending.partition(b"\0")
        return json.loads(text)

    def call(self, method, params=None, session=True, seconds=240):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params or {}}
        if session:
            message["sessionId"] = self.session
        data, mine = json.dumps(message).encode() + b"\0", self.number
        while data:
            data = data[os.write(self.out, data):]
        while True:
            answer = self._message(seconds)
            if answer.get("id") == mine:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self._note(answer)

    def _note(self, event):
        kind, p = event.get("method"), event.get("params", {})
        if kind == "Runtime.exceptionThrown":
            d = p["exceptionDetails"]
            self.errors.append(d.get("exception", {}).get("description") or d["text"])
        elif kind == "Runtime.consoleAPICalled" and p["type"] in ("error", "warning", "assert"):
            self.errors.append(" ".join(str(a.get("value", a.get("description"))) for a in p["args"]))
        elif kind == "Log.entryAdded" and p["entry"]["level"] in ("error", "warning"):
            if "(OpenGL, Performance" not in p["entry"]["text"]:  # the driver's word on a screenshot
                self.errors.append(p["entry"]["text"])
        elif kind == "Network.requestWillBeSent":
            self.requests.append(p["request"]["url"][:200])

    def size(self, width, height, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile})

    def media(self, **features):
        self.call("Emulation.setEmulatedMedia", {"features": [{"name": k.replace("_", "-"), "value": v} for k, v in features.items()]})

    def open(self, path, fragment="", seconds=240):
        self.call("Page.navigate", {"url": "about:blank"})
        self.requests.clear()
        self.call("Page.navigate", {"url": "file://" + os.path.abspath(path) + fragment})
        until = time.monotonic() + seconds
        while self.js("document.readyState==='complete'&&!!document.body&&(document.body.dataset.ready||document.body.dataset.error||'')") in ("", False, None):
            if time.monotonic() > until:
                raise TimeoutError("the page is not ready: " + str(self.js("document.body&&document.body.innerText.slice(0,300)")))
            time.sleep(0.1)
        self.rest()

    def rest(self):
        """Until what was asked for has been drawn."""
        self.js("new Promise(done=>requestAnimationFrame(()=>requestAnimationFrame(()=>setTimeout(done,0))))")

    def js(self, text):
        result = self.call("Runtime.evaluate", {"expression": text, "awaitPromise": True, "returnByValue": True})
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", result["exceptionDetails"]["text"]))
        return result["result"].get("value")

    def key(self, key, code="", shift=False):
        text = key if len(key) == 1 else ""
        common = {"key": key, "code": code or key, "modifiers": 8 if shift else 0}
        self.call("Input.dispatchKeyEvent", {"type": "keyDown", "text": text, **common})
        self.call("Input.dispatchKeyEvent", {"type": "keyUp", **common})
        self.rest()

    def drag(self, x0, y0, x1, y1):
        at = {"button": "left", "buttons": 1, "clickCount": 1}
        self.call("Input.dispatchMouseEvent", {"type": "mousePressed", "x": x0, "y": y0, **at})
        self.call("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x1, "y": y1, **at})
        self.call("Input.dispatchMouseEvent", {"type": "mouseReleased", "x": x1, "y": y1, **at})
        self.rest()

    def shot(self, path=None):
        data = base64.b64decode(self.call("Page.captureScreenshot", {"format": "png"})["data"])
        if path:
            with open(path, "wb") as out:
                out.write(data)
        return data

    def memory_mb(self):
        """Resident memory of all its processes."""
        total = 0
        for entry in os.listdir("/proc"):
            if not entry.isdigit():
                continue
            try:
                with open(f"/proc/{entry}/cmdline", "rb") as f:
                    if self.folder.encode() not in f.read():
                        continue
                with open(f"/proc/{entry}/status") as f:
                    total += sum(int(line.split()[1]) for line in f if line.startswith("RssAnon"))
            except OSError:
                pass
        return total / 1024

    def close(self):
        try:
            self.call("Browser.close", session=False, seconds=10)
        except (EOFError, TimeoutError, RuntimeError, OSError):
            pass
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
        shutil.rmtree(self.folder, ignore_errors=True)


def colours(png):
    """How often each colour stands in a picture: {(r, g, b): count}."""
    width = height = channels = 0
    packed, at = b"", 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, stride, last, out = zlib.decompress(packed), width * channels, bytearray(width * channels), collections.Counter()
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind == 1:
            for i in range(channels, stride):
                row[i] = (row[i] + row[i - channels]) & 255
        elif kind == 2:
            row = bytearray((a + b) & 255 for a, b in zip(row, last))
        elif kind == 3:
            for i in range(stride):
                row[i] = (row[i] + ((row[i - channels] if i >= channels else 0) + last[i] >> 1)) & 255
        elif kind == 4:
            for i in range(stride):
                a, b, c = (row[i - channels] if i >= channels else 0), last[i], (last[i - channels] if i >= channels else 0)
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        last = row
        out.update(zip(row[0::channels], row[1::channels], row[2::channels]))
    return out
