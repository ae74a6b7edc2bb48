"""One run of a program on a board of QEMU: its lines as they come, pictures of its panel, and how it ended."""

import json
import os
import queue
import socket
import subprocess
import tempfile
import threading
import time

from picture import read_ppm, reduce

# QEMU 7.2 says this when it puts boards together, before the first instruction: the SysTick of the LM3S6965 has no reference clock, and
# the AN505's core looks for its vectors before the image is in memory.
HARMLESS = {"Timer with period zero, disabling"} | {
    f"Invalid read at addr 0x1000000{at}, size 4, region '(null)', reason: rejected" for at in (0, 4)}

MAGNIFIED = 4  # QEMU draws a pixel of its SSD0323 as a square of 4 x 4, and a level v of 15 as 17 v


class EmulatorError(Exception):
    pass


def counted_frames(plugin, image):
    """QEMU's options that load tests/emulators/count.c: instructions from frame_begins to frame_ends of firmware/board/frames.c."""
    text = subprocess.run(["nm", image], capture_output=True, text=True, check=True).stdout
    table = {fields[2]: int(fields[0], 16) for fields in map(str.split, text.splitlines()) if len(fields) == 3}
    first, last = (table[name] & ~1 for name in ("frame_begins", "frame_ends"))
    return ["-plugin", f"file={os.path.abspath(plugin)},from={first:#x},to={last:#x}"]


class Qemu:
    """Use as a context: whatever happens, the emulator is gone afterwards."""

    def __init__(self, machine, image, options="", cpu=None, limit_s=60, more=(), semihosting=True):
        self.folder = tempfile.TemporaryDirectory(prefix="tuile-qemu-")
        self.limit = time.monotonic() + limit_s
        self.limit_s = limit_s
        self.log = os.path.join(self.folder.name, "log")
        self.last = []  # lines
        self.lines = queue.Queue()
        self.errors = []
        arguments = "".join(f",arg={word}" for word in ["frames"] + options.split())
        program = "qemu-system-riscv32" if machine in ("sifive_e", "virt") else "qemu-system-arm"
        command = [program, "-M", machine, "-display", "none", "-monitor", "none", "-serial", "stdio",
                   "-qmp", f"unix:{self.folder.name}/qmp,server=on,wait=off",
                   "-d", "guest_errors,unimp", "-D", self.log, *more]
        command += ["-semihosting-config", "enable=on,target=native" + arguments] if semihosting else []
        command += ["-cpu", cpu] if cpu else []
        command += ["-bios", "none"] if machine == "virt" else []
        command += ["-kernel", os.path.abspath(image)]
        try:
            self.process = subprocess.Popen(command, cwd=self.folder.name, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.PIPE)
        except FileNotFoundError:
            self.folder.cleanup()
            raise EmulatorError(f"{program} is not there; `make test-firmware` installs it") from None
        self.qmp = None
        for stream, sink in ((self.process.stdout, self._line), (self.process.stderr, self._error)):
            threading.Thread(target=self._read, args=(stream, sink), daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.qmp:
            self.qmp.close()
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.folder.cleanup()

    def _read(self, stream, sink):
        for line in stream:
            sink(line.decode("utf-8", "replace").rstrip("\r\n"))
        sink(None)
        stream.close()

    def _line(self, line):
        self.lines.put(line)

    def _error(self, line):
        if line is not None and line not in HARMLESS:
            self.errors.append(line)

    def _left(self):
        left = self.limit - time.monotonic()
        if left <= 0:
            raise EmulatorError(f"no end within {self.limit_s} s{self.told()}")
        return left

    def told(self):
        """The last lines, for messages."""
        text = "".join(f"\n    {line}" for line in (self.last[-5:] + self.errors[-5:]))
        return f"; the last output was:{text}" if text else "; there was no output"

    def line(self):
        """The next line, or None when the program has ended."""
        try:
            line = self.lines.get(timeout=self._left())
        except queue.Empty:
            line = None
            self._left()
        if line is not None:
            self.last.append(line)
        return line

    def go_on(self):
        """What board_shown of a program waits for."""
        try:
            self.process.stdin.write(b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            raise EmulatorError(f"the emulator is gone{self.told()}") from None

    def execute(self, command, **arguments):
        if not self.qmp:
            self.qmp = socket.socket(socket.AF_UNIX)
            self.qmp.settimeout(self._left())
            self.qmp.connect(os.path.join(self.folder.name, "qmp"))
            self.answers = self.qmp.makefile("rb")
            self.answers.readline()  # the greeting
            self.execute("qmp_capabilities")
        self.qmp.sendall(json.dumps({"execute": command, "arguments": arguments}).encode())
        while True:
            line = self.answers.readline()
            if not line:
                raise EmulatorError(f"the emulator is gone{self.told()}")
            answer = json.loads(line)
            if "error" in answer:
                raise EmulatorError(f"{command}: {answer['error']['desc']}")
            if "return" in answer:
                return answer["return"]

    def counted(self, number):
        """Instructions of the frame that was the number-th, from 1, as the plugin has counted them; None when it has not."""
        for _ in range(100):
            counts = [line.split()[1] for line in self.errors if line.startswith("instructions ")]
            if len(counts) >= number:
                return counts[number - 1]
            time.sleep(0.01)  # it comes by another pipe
        return None

    def panel(self):
        """The picture on the LM3S6965's panel, as it is; ValueError when the screen is no magnified picture."""
        path = os.path.join(self.folder.name, "screen.ppm")
        self.execute("screendump", filename=path)
        return reduce(read_ppm(path), MAGNIFIED)

    def end(self):
        """Waits for the end. The exit code, and what the emulator had to complain of: its own lines and its log."""
        try:
            code = self.process.wait(self._left())
        except subprocess.TimeoutExpired:
            self._left()
        time.sleep(0.02)  # the threads see the ends of their pipes
        complaints = list(self.errors)
        if os.path.exists(self.log):
            with open(self.log, encoding="utf-8", errors="replace") as file:
                complaints += [line.rstrip() for line in file if line.rstrip() not in HARMLESS]
        return code, complaints
