# SPDX-License-Identifier: GPL-3.0-or-later
"""Small stand-ins for OctoPrint, Moonraker and PrusaLink on the loopback: what they ask of an upload, and no more.

  print_servers.py FOLDER      prints the port, then serves until it is killed

Files that are taken lie in FOLDER/<server>/<path> afterwards. A path that holds "busy" is refused with 503 the first
time, so that who uploads must try again. Sources: OctoPrint's REST API (files), Moonraker's API (file upload),
PrusaLink's OpenAPI description (PUT /api/v1/files/{storage}/{path}).
"""

import email.parser
import email.policy
import hashlib
import http.server
import pathlib
import sys
import urllib.parse

folder = pathlib.Path(sys.argv[1])
refused = set()


def form(headers, body):
    """The parts of multipart/form-data by name: (file name or None, bytes)."""
    head = f"Content-Type: {headers['Content-Type']}\r\n\r\n".encode()
    message = email.parser.BytesParser(policy=email.policy.HTTP).parsebytes(head + body)
    return {
        part.get_param("name", header="content-disposition"): (part.get_filename(), part.get_payload(decode=True))
        for part in message.iter_parts()
    }


class Server(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def answer(self, status):
        self.send_response(status)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def keep(self, server, path, data):
        if "busy" in path and (server, path) not in refused:
            refused.add((server, path))
            return self.answer(503)
        place = folder / server / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(data)
        return self.answer(201)

    def body(self):
        return self.rfile.read(int(self.headers["Content-Length"]))

    def do_POST(self):
        body = self.body()
        parts = form(self.headers, body)
        text = lambda name: parts.get(name, (None, b""))[1].decode()
        if "file" not in parts:
            return self.answer(400)
        name, data = parts["file"]
        path = str(pathlib.PurePosixPath(text("path")) / name)
        if self.path == "/api/files/local":
            if self.headers["X-Api-Key"] != "right-key":
                return self.answer(403)
            return self.keep("octoprint", path, data)
        if self.path == "/server/files/upload":
            if text("root") != "gcodes" or text("checksum") != hashlib.sha256(data).hexdigest():
                return self.answer(422)
            return self.keep("moonraker", path, data)
        return self.answer(404)

    def do_PUT(self):
        # curl asks before it sends a large body; the base class has answered that.
        body = self.body()
        if self.headers["X-Api-Key"] != "right-key":
            return self.answer(401)
        if not self.path.startswith("/api/v1/files/usb/") or self.headers["Overwrite"] != "?1":
            return self.answer(404)
        return self.keep("prusalink", urllib.parse.unquote(self.path[len("/api/v1/files/usb/") :]), body)


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Server)
print(server.server_address[1], flush=True)
server.serve_forever()
