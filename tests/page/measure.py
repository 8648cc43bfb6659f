#!/usr/bin/python3
"""Measures a page's speed in a headless Chromium with software rendering: seconds to the first picture, and frames per
second while it moves. On a busy machine, CPU time is more meaningful than elapsed time.

usage: measure.py PAGE.html [SCREENSHOT.png]
"""
import json
import sys
import urllib.request

import browser
import websocket

MOVE = """new Promise(done => {
  const times = [], pictures = new Set(), began = performance.now();
  const step = now => {
    times.push(now);
    pictures.add(page.drawing.front.view);
    if (now - began > 5000) {
      const waits = times.slice(1).map((time, i) => time - times[i]).sort((a, b) => a - b);
      return done({ frames: waits.length / (times.at(-1) - times[0]) * 1000, wait_95: waits[Math.floor(waits.length * 0.95)],
                    longest: waits.at(-1), pictures: pictures.size });
    }
    const angle = (now - began) / 800;
    page.view.panPixels(12 * Math.cos(angle), 12 * Math.sin(angle));
    page.changed();
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
})"""


class Processor:
    """CPU seconds of the browser's processes."""

    def __init__(self, opened):
        version = json.load(urllib.request.urlopen(f"http://127.0.0.1:{opened.port}/json/version", timeout=60))
        self.socket = websocket.create_connection(version["webSocketDebuggerUrl"], timeout=60)

    def seconds(self):
        self.socket.send(json.dumps({"id": 1, "method": "SystemInfo.getProcessInfo"}))
        by_kind = {}
        for process in json.loads(self.socket.recv())["result"]["processInfo"]:
            by_kind[process["type"]] = by_kind.get(process["type"], 0.0) + process["cpuTime"]
        return by_kind


def since(before, after):
    return {kind: round(after[kind] - before.get(kind, 0.0), 2) for kind in ("renderer", "GPU")}


def main():
    with browser.Browser(1280, 800) as opened:
        processor = Processor(opened)
        before = processor.seconds()
        opened.open(sys.argv[1])
        first = opened.wait(lambda: opened.evaluate("document.documentElement?.dataset.firstPicture"), "the first picture")
        print(f"first picture after {int(first) / 1000:.2f} s; of the processor", since(before, processor.seconds()))
        if len(sys.argv) > 2:
            opened.screenshot(sys.argv[2])
        for name, zoom in (("all of it", 1), ("closer", 4), ("closer still", 4), ("close", 6)):
            before = processor.seconds()
            opened.evaluate(f"page.zoomAt({zoom})")
            opened.wait(lambda: opened.evaluate("page.frame === null && page.drawing.fits(page.drawing.front, page.view)"), "the picture")
            print(f"{name}: a picture, of the processor", since(before, processor.seconds()))
            before = processor.seconds()
            told = opened.evaluate(MOVE)
            print(f"  moved: {told['frames']:.1f} frames a second, 95 % within {told['wait_95']:.0f} ms, longest {told['longest']:.0f} ms, "
                  f"{told['pictures']} pictures; of the processor", since(before, processor.seconds()))


main()
