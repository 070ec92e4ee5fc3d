"""Bad input through the real program: exactly one line on stderr that says what was expected, exit 1 (2 for wrong usage), and what
lay at the output before still lies there. WELKIN names the program; without it these tests are skipped."""
import json
import os
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
WELKIN = os.environ.get("WELKIN", "")
BEFORE = b"what was here before"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width=8, height=4, texts=()):
    """A grey RGBA picture, with text chunks."""
    rows = b"".join(b"\0" + b"\x80" * (4 * width) for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
            + b"".join(chunk(b"tEXt", k.encode() + b"\0" + v.encode()) for k, v in texts)
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


@unittest.skipUnless(WELKIN, "WELKIN does not name the program")
class BadInput(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        with open(os.path.join(REPOSITORY, "benchmarks/poses/near.json"), encoding="utf-8") as f:
            self.scene = json.load(f)
        self.scene["clouds"] = {"sources": [{"type": "cover-map", "file": "cover.png"}]}
        self.put("scene.json", json.dumps(self.scene))
        self.path = {"scene": "scene.json", "size": [32, 18], "time_step_s": 0.04, "warm_up": 0,
                     "frames": [{"position_m": [0, 0, 6371000], "orientation_xyzw": [0, 0, 0, 1], "fov_deg": 58, "time_s": 0}]}
        self.out = self.put("out.png", BEFORE)

    def at(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, content):
        with open(self.at(name), "wb") as f:
            f.write(content if isinstance(content, bytes) else content.encode())
        return self.at(name)

    def run_welkin(self, *arguments, **environment):
        return subprocess.run([WELKIN, *arguments], capture_output=True, text=True, check=False, timeout=120,
                              env={**os.environ, **environment})

    def fails(self, exit_status, says, *arguments, **environment):
        done = self.run_welkin(*arguments, **environment)
        lines = done.stderr.splitlines()
        if "--quiet" not in arguments:  # log lines come before; the error is the last line
            lines = [line for line in lines if line.startswith("welkin: ")]
        self.assertEqual(done.returncode, exit_status, (arguments, done.stderr))
        self.assertEqual(len(lines), 1, (arguments, done.stderr))
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, lines[0], arguments)
        with open(self.out, "rb") as f:
            self.assertEqual(f.read(), BEFORE, arguments)
        self.assertEqual([n for n in os.listdir(self.folder) if n.startswith("out.png") and n != "out.png"], [], "a temporary stayed")

    def render_fails(self, says, scene, *more, exit_status=1, **environment):
        self.fails(exit_status, says, "render", scene, "-o", self.out, "--quiet", "--size", "32x18", "--budget", "64MiB", *more, **environment)

    def changed(self, *place, value):
        """The scene with one value changed, in a file."""
        scene = json.loads(json.dumps(self.scene))
        inner = scene
        for key in place[:-1]:
            inner = inner[key]
        inner[place[-1]] = value
        return self.put("changed.json", json.dumps(scene))  # writes NaN as NaN, which JSON does not have

    def test_scene(self):
        self.render_fails(["none.json", "cannot be read"], self.at("none.json"))
        self.render_fails("folder", self.folder)
        whole = json.dumps(self.scene)
        for n in [0, 1, len(whole) // 2, len(whole) - 1]:
            self.render_fails("cut.json", self.put("cut.json", whole[:n]))
        for text in ["[]", "7", "null", "\0\0\0\0", "\xff\xfe", "{\"planet\": [}"]:
            self.render_fails("odd.json", self.put("odd.json", text.encode("latin-1")))

    def test_numbers_and_keys_of_a_scene(self):
        for place, value in [(("planet", "radius_m"), -1), (("planet", "radius_m"), float("nan")), (("planet", "radius_m"), "far"),
                             (("planet", "radius_m"), 1e300), (("quality", "depth"), 0), (("quality", "depth"), 25), (("quality", "depth"), 2.5),
                             (("quality", "budget"), "lots"), (("quality", "budget"), "-5MiB"), (("quality", "step"), 0),
                             (("views", "near", "fov_deg"), 0), (("views", "near", "fov_deg"), 180), (("views", "near", "latitude_deg"), 91),
                             (("views", "near", "altitude_m"), -1e9), (("sun", "irradiance"), [1, 1]), (("sun", "irradiance"), [-1, 1, 1]),
                             (("clouds", "sources", 0, "type"), "cotton")]:
            says = ["changed.json"] if value != value else ["changed.json", "/" + "/".join(map(str, place)), "expected"]
            self.render_fails(says, self.changed(*place, value=value))
        for place in [("cloudz",), ("planet", "radius_km"), ("views", "near", "tilt"), ("clouds", "sources", 0, "cover")]:
            self.render_fails(["changed.json", "/" + "/".join(map(str, place)), "unknown key"], self.changed(*place, value=1))
        self.render_fails(["scene.json", "/views", "expected one of", "far"], self.at("scene.json"), "--view", "far")

    def test_path(self):
        def fly(says, text, *more):
            self.fails(1, says, "fly", self.put("path.json", text), "--out", self.at("flight"), "--quiet", *more)

        good = json.dumps(self.path)
        self.fails(1, "none.json", "fly", self.at("none.json"), "--out", self.at("flight"), "--quiet")
        for n in [0, 1, len(good) // 2, len(good) - 1]:
            fly("path.json", good[:n])
        fly(["path.json", "/scene"], json.dumps({**self.path, "scene": "gone.json"}))
        fly(["path.json", "/size"], json.dumps({**self.path, "size": [0, 18]}))
        fly(["path.json", "/size"], json.dumps({**self.path, "size": [100000, 18]}))
        fly(["path.json", "/frames"], json.dumps({**self.path, "frames": []}))
        fly(["path.json", "/speed", "unknown key"], json.dumps({**self.path, "speed": 1}))
        fly(["path.json", "/time_step_s"], json.dumps({**self.path, "time_step_s": -1}))
        frame = self.path["frames"][0]
        fly(["path.json", "/frames/0"], json.dumps({**self.path, "frames": [{**frame, "position_m": [0, 0, 1000]}]}))  # below the ground
        fly(["path.json", "/frames/0"], json.dumps({**self.path, "frames": [{**frame, "orientation_xyzw": [0, 0, 0, 0]}]}))
        fly("path.json", json.dumps({**self.path, "frames": [{**frame, "fov_deg": float("nan")}]}))
        fly(["path.json", "--frames"], good, "--frames", "0:2")

    def test_picture(self):
        self.render_fails(["plain.png", "welkin"], self.put("plain.png", png()))
        self.render_fails("odd.png", self.put("odd.png", png(texts=[("welkin:scene", "{"), ("welkin:version", "1")])))
        whole = png()
        for n in [8, 20, len(whole) // 2, len(whole) - 5]:
            self.render_fails("cut.png", self.put("cut.png", whole[:n]))
            self.fails(1, "cut.png", "compare", self.at("cut.png"), self.at("cut.png"), "--quiet")

    def test_data(self):
        whole = png(64, 32)
        for n in [0, 8, len(whole) // 2]:
            self.put("cover.png", whole[:n])
            self.render_fails("cover.png", self.at("scene.json"))
        self.put("cover.png", "not a picture")
        self.render_fails("cover.png", self.at("scene.json"))
        os.remove(self.at("cover.png"))
        os.mkdir(self.at("cover.png"))
        self.render_fails("cover.png", self.at("scene.json"))

    def test_budget(self):
        self.put("cover.png", png(64, 32))
        self.fails(1, ["budget", "least", "MiB"], "render", self.at("scene.json"), "-o", self.out, "--quiet", "--size", "32x18", "--budget", "1MiB")

    def test_usage(self):
        for more in [["--size", "0x18"], ["--size", "32x0"], ["--size", "100000x100000"], ["--size", "-3x5"], ["--size", "nanx5"],
                     ["--budget", "-1MiB"], ["--budget", "nan"], ["--budget", ""], ["--depth", "0"], ["--depth", "25"], ["--step", "nan"],
                     ["--step", "0"], ["--step", "-1"], ["--step", "inf"], ["--seed", "-1"], ["--gpu", "fast"], ["--colour", "red"],
                     ["--exposure", "nan"], ["--exposure", "41"], ["--tone-curve", "film"]]:
            self.fails(2, "welkin: ", "render", self.at("scene.json"), "-o", self.out, *more)
        self.fails(2, "welkin: ", "render", self.at("scene.json"))
        self.fails(2, "welkin: ", "render", self.at("scene.json"), "-o", self.at("out.bmp"))
        self.fails(2, "welkin: ", "dance")
        self.fails(1, "`welkin render`", DISPLAY="", WAYLAND_DISPLAY="")  # without arguments: the window, which has no display here
        self.fails(2, "welkin: ", "bench", self.at("scene.json"), "--frames", "0")

    def test_places_that_cannot_be_written(self):
        self.put("cover.png", png(64, 32))
        self.put("path.json", json.dumps(self.path))
        self.fails(1, "/proc/none", "render", self.at("scene.json"), "-o", "/proc/none/out.png", "--quiet")
        self.fails(1, "/proc/none", "fly", self.at("path.json"), "--out", "/proc/none", "--quiet")
        self.fails(1, "out.png", "fly", self.at("path.json"), "--out", self.out, "--quiet")  # a file where a folder should be
        self.fails(1, "/proc/none", "bench", self.at("scene.json"), "--json", "/proc/none/b.json", "--quiet")

    def test_old_opengl(self):
        self.put("cover.png", png(64, 32))
        self.render_fails("4.5", self.at("scene.json"), "--gpu", "software", MESA_GL_VERSION_OVERRIDE="3.3")


if __name__ == "__main__":
    unittest.main()
