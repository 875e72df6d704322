"""Plans a document offline and tells what it took."""
import json
import os
import subprocess
import tempfile
import threading


def plan(binary, document, most_seconds=None):
    """The result or the problem, processor time in s and the largest memory in MB. A plan that takes longer is ended."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as job:
        json.dump(document, job)
        job.flush()
        child = subprocess.Popen([binary, "plan", job.name], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        end = threading.Timer(most_seconds, child.kill) if most_seconds else None
        if end:
            end.start()
        output = child.stdout.read()
        if end:
            end.cancel()
        _, status, usage = os.wait4(child.pid, 0)
    if not output:
        return {"title": "no answer", "detail": f"ended with status {status}"}, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
    return json.loads(output), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
