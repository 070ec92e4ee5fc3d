#!/usr/bin/python3
"""picture_window.py --build BUILD --size 1280x800 --keys 6 -o docs/figures/window.png [what `welkin view` takes ...]: the window as it is
when its tree is there, on a display of its own (Xvfb). --keys: pressed first, such as panels; the camera's panel is open at the start.
--seconds: at most so long."""

import argparse
import os
import sys
import tempfile
import time

from window_driver import Screen, Window, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--keys", default="", help="by comma")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("-o", "--output", required=True)
    options, view = parser.parse_known_args()
    if missing():
        sys.exit(f"picture_window: {', '.join(missing())} is missing (Debian: xvfb, xdotool)")
    screen = Screen(*[int(n) for n in options.size.split("x")])
    with tempfile.TemporaryDirectory() as folder:
        window = Window(os.path.abspath(options.build), screen, folder, *view, size=options.size)
        try:
            if options.keys:
                window.key(*options.keys.split(","))
            end = time.time() + options.seconds
            while time.time() < end and not ((window.fresh() or {}).get("settled") and time.time() > end - options.seconds + 25):
                time.sleep(1)
            window.capture(options.output)
            print({k: window.state()[k] for k in ("picture", "scale", "settled", "bricks_to_come", "frame_rate")})
        finally:
            window.close()
            screen.close()


if __name__ == "__main__":
    main()
