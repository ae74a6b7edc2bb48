"""What a board without a panel has put on its wire, read by the model of a panel's chip."""

import os
import subprocess


def read_wire(program, panel, qemu, folder):
    """The lines that were told, and what is to be complained of; pictures of the frames are in the folder. program: wire_trace, built."""
    trace = os.path.join(qemu.folder.name, "wire.trace")
    os.makedirs(folder, exist_ok=True)
    if not os.path.exists(trace):
        return [], ["there is no wire.trace"]
    with open(trace, "rb") as file:
        result = subprocess.run([program, panel, "0", folder], stdin=file, capture_output=True, text=True, check=False)
    complaints = result.stderr.splitlines()
    if result.returncode and not complaints:
        complaints.append(f"{program} ended with {result.returncode}")
    return result.stdout.splitlines(), complaints
