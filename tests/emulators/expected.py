"""What a board must show: the frames that the simulator draws for its panel."""

import os
import subprocess

from picture import read_ppm


class Simulator:
    """Draws scenes as they are asked for, and keeps them."""

    def __init__(self, tuile, models, panel, folder):
        self.tuile, self.models, self.panel, self.folder = tuile, models, panel, folder
        self.drawn = {}

    def frames(self, scene, method, count):
        """Pictures of the frames 0 ... count - 1."""
        key = (scene, method)
        if len(self.drawn.get(key, ())) < count:
            os.makedirs(self.folder, exist_ok=True)
            out = os.path.join(self.folder, f"{scene}-{method}-%02d.ppm")
            result = subprocess.run([self.tuile, "scene", scene, "--models", self.models, "--panel", self.panel, "--method", method,
                                     "--frames", str(count), "--out", out], capture_output=True, text=True, check=False)
            if result.returncode:
                raise RuntimeError(f"the simulator cannot draw {scene} by {method}: {result.stderr.strip()}")
            self.drawn[key] = [read_ppm(out % frame) for frame in range(count)]
        return self.drawn[key]


def differ(board, simulated, name, folder):
    """None, or a line that tells how the two pictures differ; both are then in the folder."""
    if board == simulated:
        return None
    if (board.width, board.height) != (simulated.width, simulated.height):
        return f"{name}: the board shows {board.width}x{board.height}, the simulator {simulated.width}x{simulated.height}"
    places = board.differences(simulated)
    x, y = places[0]
    paths = [os.path.join(folder, f"{name}-{who}.png") for who in ("board", "simulator")]
    board.write(paths[0])
    simulated.write(paths[1])
    return (f"{name}: {len(places)} of {board.width * board.height} pixels differ, the first at {x},{y}: {board.pixel(x, y)} on the "
            f"board, {simulated.pixel(x, y)} in the simulator; see {paths[0]} and {paths[1]}")
