"""Opens the report of every result folder in headless Chromium, on a phone, on a desk and on paper, and names what a reader
would see go wrong. It speaks the DevTools protocol through a pipe: no package is needed.

usage: browser.py CHROMIUM FOLDERS [SCREENSHOTS]
"""
import base64
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

WIDTHS = {"phone": 360, "desk": 1280}  # [px]
PAPER = 718  # [px] A4 less the margins that Chromium leaves: what a page holds at full size

# What the page looks like from inside: a list of complaints.
MEASURE = r"""
(() => {
  const complaints = [], told = new Set(), width = WIDTH, page = document.documentElement;
  const name = e => e.tagName.toLowerCase() + (e.className && e.className.baseVal === undefined ? '.' + e.className : '') +
                    ' "' + e.textContent.trim().slice(0, 40) + '"';
  if (page.scrollWidth > width) complaints.push(`the page is ${page.scrollWidth} px wide, not ${width}`);
  for (const e of document.querySelectorAll('main *')) {
    if (e.closest('svg')) continue;
    const box = e.getBoundingClientRect();
    if (box.width === 0) continue;
    const scroller = e.closest('.wide, pre');
    if (scroller && scroller !== e && getComputedStyle(scroller).overflowX === 'auto') continue;  // it scrolls
    if (told.has(e.parentElement)) told.add(e);
    else if (box.right > width + 1 || box.left < -1) told.add(e), complaints.push(`${name(e)} reaches from ${box.left} to ${box.right} px`);
  }
  for (const svg of document.querySelectorAll('svg')) {
    const frame = svg.getBoundingClientRect(), title = svg.getAttribute('aria-label');
    if (frame.width < 200 || frame.height < 100) complaints.push(`figure "${title}": ${frame.width} x ${frame.height} px`);
    let words = 0;
    for (const text of svg.querySelectorAll('text')) {
      if (!text.textContent.trim() || text.closest('defs')) continue;
      words++;
      const box = text.getBoundingClientRect();
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1)
        complaints.push(`figure "${title}": "${text.textContent.trim()}" is clipped`);
    }
    if (words < 5) complaints.push(`figure "${title}": ${words} words`);
  }
  const size = parseFloat(getComputedStyle(document.querySelector('.answer')).fontSize);
  if (!(size >= MINIMUM)) complaints.push(`the answer is set in ${size} px`);
  return complaints;
})()
"""


class Browser:
    def __init__(self, program, profile):
        read_in, self.write_to = os.pipe()
        self.read_from, write_out = os.pipe()

        def give_pipes():  # the protocol is spoken on descriptors 3 and 4
            os.dup2(read_in, 60)
            os.dup2(write_out, 61)
            os.dup2(60, 3)
            os.dup2(61, 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe",
             "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}", "about:blank"],
            close_fds=False, preexec_fn=give_pipes, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(read_in)
        os.close(write_out)
        self.number, self.rest, self.events = 0, b"", []

    def read(self):
        while b"\0" not in self.rest:
            chunk = os.read(self.read_from, 1 << 20)
            if not chunk:
                sys.exit("Chromium ended too soon")
            self.rest += chunk
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, session=None, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if session:
            message["sessionId"] = session
        os.write(self.write_to, json.dumps(message).encode() + b"\0")
        while True:
            reply = self.read()
            if reply.get("id") == self.number:
                if "error" in reply:
                    sys.exit(f"{method}: {reply['error']['message']}")
                return reply["result"]
            self.events.append(reply)

    def wait_for(self, method):
        while not any(event.get("method") == method for event in self.events):
            self.events.append(self.read())

    def close(self):
        self.call("Browser.close")
        self.process.wait(timeout=30)


def event_complaints(events, address):
    for event in events:
        method, params = event.get("method"), event.get("params", {})
        if method == "Network.requestWillBeSent":
            url = params["request"]["url"]
            if url != address and not url.startswith("data:"):
                yield f"asks for {url[:100]}"
        elif method == "Runtime.exceptionThrown":
            yield f"throws: {params['exceptionDetails']['text']}"
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning", "assert"):
            yield f"console: {params['type']}"
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            yield f"console: {params['entry']['text'][:200]}"


def look_at(browser, session, address, width, media, shot):
    """Every complaint about one page at one width."""
    browser.events.clear()
    browser.call("Emulation.setEmulatedMedia", session, media=media)
    browser.call("Emulation.setDeviceMetricsOverride", session, width=width, height=900, deviceScaleFactor=1, mobile=False)
    browser.call("Page.navigate", session, url=address)
    browser.wait_for("Page.loadEventFired")
    script = MEASURE.replace("WIDTH", str(width)).replace("MINIMUM", "12" if media == "print" else "16")
    answer = browser.call("Runtime.evaluate", session, expression=script, returnByValue=True)
    if "exceptionDetails" in answer:
        sys.exit(f"{address}: {answer['exceptionDetails']}")
    if shot:
        picture = browser.call("Page.captureScreenshot", session, captureBeyondViewport=True)
        pathlib.Path(shot).write_bytes(base64.b64decode(picture["data"]))
    return answer["result"]["value"] + list(event_complaints(browser.events, address))


def print_complaints(browser, session, file):
    browser.call("Emulation.setEmulatedMedia", session, media="")
    pdf = base64.b64decode(browser.call("Page.printToPDF", session, paperWidth=8.27, paperHeight=11.69)["data"])
    if file:
        pathlib.Path(file).write_bytes(pdf)
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    if not pdf.startswith(b"%PDF-") or not 2 <= pages <= 60:
        yield f"prints on {pages} pages"


def main(program, folders, shots=None):
    reports = sorted(pathlib.Path(folders).resolve().glob("*/report.html"))
    if not reports:
        sys.exit(f"{folders}: no report was found")
    bad = 0
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(program, profile)
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            browser.call(f"{domain}.enable", session)
        for report in reports:
            name = report.parent.name
            found = []
            for place, width in WIDTHS.items():
                shot = shots and f"{shots}/{name}_{place}.png"
                found += [f"{place}: {c}" for c in look_at(browser, session, report.as_uri(), width, "screen", shot)]
            found += [f"paper: {c}" for c in look_at(browser, session, report.as_uri(), PAPER, "print", None)]
            found += [f"paper: {c}" for c in print_complaints(browser, session, shots and f"{shots}/{name}.pdf")]
            for complaint in found[:12]:
                print(f"{name}: {complaint}")
            bad += len(found)
        browser.close()
    print(f"{len(reports)} reports, {bad} complaints")
    sys.exit(1 if bad else 0)


main(*sys.argv[1:])
