"""The lines of firmware/board/frames.c, checked: which frames came, what was left out, how much stack was used."""

FAULTS = {"hard": 64, "stack": 65, "assert": 66}  # on purpose, and the codes that they end with (board_code_t)


class Frames:
    def __init__(self):
        self.shown = {}  # (scene, method): number of frames, which came as 0, 1, 2 ...
        self.skipped = {}  # (scene, method): bytes that were wanted
        self.size = None  # of the display
        self.stack = None  # used, room
        self.faults = []

    def take(self, line):
        """(scene, method, frame) when the line tells a frame, else None."""
        words = line.split()
        kind = words[0] if words else ""
        if kind == "frame" and len(words) >= 6:
            scene, method, number = words[1], words[2], int(words[3])
            if number != self.shown.get((scene, method), 0):
                self.faults.append(f"{scene} {method}: frame {number} came, not {self.shown.get((scene, method), 0)}")
            self.shown[scene, method] = number + 1
            return scene, method, number
        if kind == "skip" and len(words) == 5:
            self.skipped[words[1], words[2]] = int(words[4])
        elif kind == "board" and len(words) == 3:
            self.size = int(words[1]), int(words[2])
        elif kind == "stack" and len(words) == 4:
            self.stack = int(words[1]), int(words[3])
        else:
            self.faults.append(line)
        return None

    def missing(self, wanted, count):
        """Of `wanted`, a list of (scene, method), those of which fewer frames than count came; and those that all came unasked."""
        return ([f"{scene} by {method}: {self.shown.get((scene, method), 0)} of {count} frames" for scene, method in wanted
                 if self.shown.get((scene, method), 0) < count] +
                [f"{scene} by {method}: not in the board's list" for (scene, method), shown in self.shown.items()
                 if shown >= count and (scene, method) not in wanted])

    def too_much_stack(self, most):
        """A list of one fault when more was used than the call graph allows (None: it was not asked), else an empty one."""
        if self.stack and most and self.stack[0] > most:
            return [f"{self.stack[0]} bytes of stack were used, but the call graph has at most {most}"]
        return []


def read_wanted(path):
    """firmware/BOARD/frames: a line for each scene, with the methods that draw it on the board."""
    wanted = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split("#")[0].split()
            wanted += [(words[0], method) for method in words[1:]]
    return wanted
