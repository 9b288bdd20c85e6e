"""Where the decks are: the project's own examples and the shared folder with reference results."""
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

OWN = ["bars", "plates", "plates_gap0", "plates_plastic", "slide", "cyl", "mixed", "stack", "press", "press_slip"]
THIRD_PARTY = ["INT357", "FRICT41", "BOX1BL", "CT3AV4", "BLOCK", "CONV_ELS"]
EXAMPLES = ["plate_drop", "block_on_block", "slope", "press_fit", "drop_type7", "drop_type3"]


def shared_folder():
    """The folder with reference decks: ABUT_DECKS, else ../shared/decks beside the source tree."""
    return Path(os.environ.get("ABUT_DECKS") or ROOT.parent / "shared" / "decks").resolve()


def folder_of(name):
    """Folder of a deck, whether it exists or not."""
    if name in EXAMPLES:
        return ROOT / "examples" / "decks" / name
    if name in THIRD_PARTY:
        return shared_folder() / "third-party" / name
    return shared_folder() / name
