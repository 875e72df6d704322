#!/usr/bin/env python3
"""A proxy that breaks event streams off: cutting_proxy.py HOST:PORT CUT… forwards to that service; the answers to the
first requests for events end after so many bytes each, all other answers are whole. Prints its own port, then for each
request for events its Last-Event-ID, or -."""
import http.client
import re
import socketserver
import sys
import threading

host, port = sys.argv[1].rsplit(":", 1)
cuts = [int(cut) for cut in sys.argv[2:]]
lock = threading.Lock()


class Proxy(socketserver.StreamRequestHandler):
    def handle(self):
        request = b""
        while b"\r\n\r\n" not in request:
            piece = self.request.recv(65536)
            if not piece:
                return
            request += piece
        head, body = request.split(b"\r\n\r\n", 1)
        length = re.search(rb"(?i)^content-length: *(\d+)", head, re.M)
        while length and len(body) < int(length[1]):
            body += self.request.recv(65536)
        budget = None
        if b"/events " in head.split(b"\r\n", 1)[0]:
            last = re.search(rb"(?i)^last-event-id: *(\S+)", head, re.M)
            with lock:
                budget = cuts.pop(0) if cuts else None
                print(last[1].decode() if last else "-", flush=True)
        # One request per connection, so that each answer ends with its own.
        head = re.sub(rb"(?im)^connection:.*\r\n", b"", head + b"\r\n")[:-2] + b"\r\nConnection: close\r\n\r\n"
        upstream = http.client.HTTPConnection(host, int(port))
        upstream.connect()
        upstream.sock.sendall(head + body)
        while budget is None or budget > 0:
            piece = upstream.sock.recv(65536 if budget is None else budget)
            if not piece:
                break
            if budget is not None:
                budget -= len(piece)
            try:
                self.request.sendall(piece)
            except OSError:  # the client has gone
                break
        upstream.close()


class Server(socketserver.ThreadingTCPServer):
    daemon_threads = True


with Server(("127.0.0.1", 0), Proxy) as server:
    print(server.server_address[1], flush=True)
    server.serve_forever()
