"""Plans a document offline and tells what it took."""
import json
import os
import subprocess
import tempfile


def plan(binary, document):
    """The result or the problem, processor time in s and the largest memory in MB."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as job:
        json.dump(document, job)
        job.flush()
        child = subprocess.Popen([binary, "plan", job.name], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        output = child.stdout.read()
        _, _, usage = os.wait4(child.pid, 0)
    return json.loads(output), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
