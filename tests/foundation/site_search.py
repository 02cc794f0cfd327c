#!/usr/bin/env python3
"""The search of the documentation, opened as a file in a browser, finds what is sought.

    site_search.py ROOT SITE BROWSER      builds the site into SITE first
"""
import base64
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request

root, site, browser = sys.argv[1:4]
longest = 120  # [s]


class DevTools:
    """As much of the protocol of a browser's tools as evaluates an expression in its page: JSON over a web socket (RFC 6455)."""

    def __init__(self, port):
        page = next(t for t in json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json")) if t["type"] == "page")
        self.socket = socket.create_connection(("127.0.0.1", port))
        path = page["webSocketDebuggerUrl"].split(str(port), 1)[1]
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        self.stream = self.socket.makefile("rb")
        while self.stream.readline().strip():
            pass

    def value_of(self, expression):
        self.send({"id": 1, "method": "Runtime.evaluate", "params": {"expression": expression, "returnByValue": True}})
        while True:
            answer = self.receive()
            if answer.get("id") == 1:
                return answer["result"]["result"].get("value")

    def send(self, message):
        text, mask = json.dumps(message).encode(), os.urandom(4)
        masked = bytes(letter ^ mask[k % 4] for k, letter in enumerate(text))
        self.socket.sendall(b"\x81\xfe" + struct.pack(">H", len(text)) + mask + masked)

    def receive(self):
        text, last = b"", False
        while not last:
            first, length = self.stream.read(2)
            last = bool(first & 0x80)
            if length == 126:
                length = struct.unpack(">H", self.stream.read(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.stream.read(8))[0]
            text += self.stream.read(length)
        return json.loads(text)


def awaited(what, found):
    end = time.monotonic() + longest
    while time.monotonic() < end:
        if (value := found()) is not None:
            return value
        time.sleep(0.3)
    sys.exit(f"waited for {what} in vain")


def port_in(profile):
    file = os.path.join(profile, "DevToolsActivePort")
    return int(open(file, encoding="ascii").readline()) if os.path.exists(file) and os.path.getsize(file) else None


subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--config-file", root + "/mkdocs.yml", "--site-dir", site], check=True,
               env={**os.environ, "PYTHONWARNINGS": "ignore"})
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
    page = f"file://{os.path.abspath(site)}/index.html?q=cohesion"
    words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0", f"--user-data-dir={profile}", page]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        try:
            tools = DevTools(awaited("the browser", lambda: port_in(profile)))
            said = "document.querySelector('.md-search-result__meta')?.innerText"
            counted = awaited("the search", lambda: (text := tools.value_of(said)) and "matching" in text and text or None)
            titles = tools.value_of("[...document.querySelectorAll('.md-search-result__title')].map(t => t.innerText).join('; ')")
        finally:
            running.terminate()
print(counted, "-", titles)
if "constants" not in titles:
    sys.exit("what was found says nothing of the constants of a law")
