"""Blender, three.js, Assimp and Khronos' validator, asked where they have the joints and vertices of a file."""
import collections
import itertools
import json
import math
import os
import pathlib
import struct
import subprocess
import threading

import point_files

TOLERANCE = 1e-4  # of the height
# Blender takes an FBX's angles apart in single precision. Near ±90° of the middle one (CesiumMan's pelvis in frame 1:
# -89.988°) they then lack half their digits: put together again in double precision, the file's own angles leave joints
# up to 3.8e-4 m off Blender's pose. In all other frames, and of all other files, everything is within 6e-5.
FBX_TOLERANCE = 1e-3
# Blender keeps a bone's rest orientation as a tail and a roll in single precision; of the mannequin's hips it makes a
# matrix whose columns are 2.4e-5 too long or short, and by so much its way is: 1.3e-4 of its height after 8 m of a run.
BLENDER_BONES = 3e-5  # of the distance from the origin, where that is more than TOLERANCE
HOME = pathlib.Path(__file__).resolve().parents[2]
TOOLS = pathlib.Path(os.environ.get("KINEGRAPH_TOOLS", HOME / "../shared/tools")).resolve()
MOCAP = pathlib.Path(os.environ.get("KINEGRAPH_MOCAP", HOME / "../shared/mocap")).resolve()

# Blender looks for its Python's modules beside the first python3 of PATH: that has to be Debian's.
ENVIRONMENT = {**os.environ, "PATH": "/usr/bin:/bin:" + os.environ.get("PATH", "")}


def run(*words, folder=None):
    words = [str(word) for word in words]
    done = subprocess.run(words, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode:
        told = (done.stdout + done.stderr).strip().splitlines()[-8:]
        raise RuntimeError("\n    ".join([f"{' '.join(words)}: exit {done.returncode}", *told]))
    return done.stdout


# What was found of a client (a column) about a file: the largest distance as a part of the height and where, or how
# many messages and which. `worst` None: it is not asked, as `where` says.
Checked = collections.namedtuple("Checked", "file client worst where limit", defaults=(TOLERANCE,))


class Blender:
    """One that runs scripts, started when it is needed."""

    def __init__(self):
        self.process = None

    def run(self, script, *words):
        if not self.process:
            self.process = subprocess.Popen(
                ["blender", "-b", "--factory-startup", "--python", HOME / "tests/clients/blender_worker.py"],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=ENVIRONMENT)
        self.process.stdin.write(json.dumps([str(word) for word in (script, *words)]) + "\n")
        self.process.stdin.flush()
        told = []
        for line in self.process.stdout:
            if line.startswith("done "):
                if failed := json.loads(line[5:]):
                    raise RuntimeError(f"Blender, {script} {words}: {failed}")
                return
            told.append(line)
        self.process = None
        raise RuntimeError(f"Blender, {script} {words}: {''.join(told[-8:])}")

    def end(self):
        if self.process:
            self.process.stdin.close()
            self.process.wait()


class Clients:
    def __init__(self, program, folder):
        self.program = pathlib.Path(program).resolve()
        self.folder = pathlib.Path(folder)
        self.of_thread, self.blenders = threading.local(), []
        self.npm = self.folder / "npm"
        self.npm.mkdir()
        run("npm", "install", "--silent", "--no-audit", "--no-fund", "three", "gltf-validator", folder=self.npm)
        self.assimp = self.program.with_name("assimp_positions")
        if not self.assimp.exists():
            print(f"Assimp is not asked: there is no {self.assimp} (scripts/install build, then build again).")

    def export(self, case, document, exported="out.bvh"):
        folder = self.folder / case
        folder.mkdir(exist_ok=True)
        (folder / "g.kg.json").write_text(document)
        run(self.program, "run", folder / "g.kg.json", "--out", folder, "--progress", "none")
        return folder / exported

    def ours(self, file, out, *cut):
        run(self.program.with_name("joint_positions"), file, out, *cut)
        return json.loads(out.read_text())

    def blender(self, script, *words):
        if not hasattr(self.of_thread, "blender"):
            self.of_thread.blender = Blender()
            self.blenders.append(self.of_thread.blender)
        self.of_thread.blender.run(script, *words)

    def end(self):
        for blender in self.blenders:
            blender.end()

    def check(self, case, exported, source, cut=()):
        """All clients about a BVH or a glTF. `source`: what it was exported from, cut so; None: as Kinegraph reads it."""
        folder, name = exported.parent, case + (".glb" if exported.suffix != ".bvh" else "")
        written = self.ours(exported, folder / f"{exported.name}.ours.json")
        ours = self.ours(source, folder / f"{exported.name}.source.json", *cut) if source else written
        ours["names"] = written["joints"]
        is_bvh = exported.suffix == ".bvh"
        results = [] if is_bvh else [Checked(name, "validator", *self.validity(exported, least="1"), 0),
                                     *self.skin(name, exported, written)]
        if not written["height"]:  # no skeleton: a mesh whose shape is all that moves
            return results
        if not is_bvh and source:  # in metres
            scale = ours["unit"]
            ours["positions"] = [[[x * scale for x in p] for p in frame] for frame in ours["positions"]]
            ours["height"] *= scale
        rate = () if is_bvh else (written["fps"],)
        asked = {"Blender": lambda out: self.blender(TOOLS / "positions_blender.py", exported, out, *rate),
                 "three.js": lambda out: run("node", TOOLS / "positions_three.mjs", without_textures(exported), out,
                                             *rate, folder=self.npm),
                 "Assimp": lambda out: run(self.assimp, exported, out, *rate)}
        for client, ask in asked.items():
            if why := self.why_not(client, is_bvh, written):
                results.append(Checked(name, client, None, why))
                continue
            out = folder / f"{exported.name}.{client}.json"
            ask(out)
            theirs = json.loads(out.read_text())
            if client == "Assimp":  # its nodes are joints, End Sites, and what stands above
                keep = [i for i, joint in enumerate(theirs["joints"]) if joint in set(written["joints"])]
                theirs["joints"] = [theirs["joints"][i] for i in keep]
                theirs["positions"] = [[frame[i] for i in keep] for frame in theirs["positions"]]
            places = itertools.chain.from_iterable(ours["positions"])
            limit = limit_of_blender(places, ours) if client == "Blender" and not is_bvh else TOLERANCE
            results.append(Checked(name, client, *difference(ours, theirs), limit))
        return results

    def why_not(self, client, is_bvh, written):
        """Why a client can't be asked about a file."""
        if client == "Assimp":
            if not self.assimp.exists():
                return "not here"
            return "blanks" if is_bvh and any(" " in name for name in written["joints"]) else ""
        if client == "Blender" or not is_bvh:
            return ""
        first_words = {name.split()[0] for name in written["joints"]}
        if len(first_words) < len(written["joints"]) or set("".join(first_words)) & set(".:/[]"):
            return "names"
        return "offsets" if written["offset_and_position"] else ""

    def skin(self, name, exported, written):
        """Every vertex of a character, in every seventh frame."""
        folder, every, fps = exported.parent, 7, written["fps"]
        ours = self.ours(exported, folder / f"{exported.name}.skin.json", "--vertices", every)
        if "vertices" not in ours:
            return []
        results = []
        for client in ("Blender", "three.js"):
            out = folder / f"{exported.name}.skin.{client}.json"
            if client == "Blender":
                self.blender(HOME / "tests/clients/vertices_blender.py", exported, out, fps, every)
            else:
                run("node", HOME / "tests/clients/vertices_three.mjs", without_textures(exported), out, fps, every,
                    folder=self.npm)
            theirs = json.loads(out.read_text())
            places = itertools.chain.from_iterable(ours["vertices"].values())
            limit = limit_of_blender(places, ours) if client == "Blender" and written["height"] else TOLERANCE
            results.append(Checked(name, f"{client} skin", *farthest_vertex(ours, theirs, limit), limit))
        return results

    def fbx(self, case, source, *axis_up):
        folder = self.folder / case
        folder.mkdir()
        self.blender(HOME / "tests/clients/make_fbx.py", source, folder / "in.fbx", folder / "blender.json", *axis_up)
        theirs = json.loads((folder / "blender.json").read_text())
        ours = self.ours(folder / "in.fbx", folder / "ours.json", "--vertices", 7)
        if ours["fps"] != theirs["fps"]:
            return [Checked(case, "Blender", math.inf, f"{ours['fps']} frames a second, not {theirs['fps']}")]
        for points in [*ours["positions"], *ours.get("vertices", {}).values()]:
            points[:] = [[x * ours["unit"] for x in p] for p in points]
        ours["height"] *= ours["unit"]
        ours["names"] = ours["joints"]
        results = [Checked(case, "Blender", *difference(ours, theirs), FBX_TOLERANCE)]
        if theirs["vertices"]:
            results.append(Checked(case, "Blender skin", *farthest_vertex(ours, theirs), FBX_TOLERANCE))
        return results

    def messages(self, file, least="3"):
        """How many messages of each code the validator has about a file: errors are 0, warnings 1, infos 2, hints 3."""
        try:
            told = run("node", TOOLS / "check_gltf.mjs", file, folder=self.npm)
        except RuntimeError as problem:
            told = str(problem)
            if "errors" not in told and "severity" not in told:
                raise
        words = [line.split() for line in told.splitlines() if line.strip().startswith("severity")]
        return collections.Counter(code for _, severity, code, *_ in words if severity <= least)

    def validity(self, file, allowed=collections.Counter(), least="3"):
        more = self.messages(file, least) - allowed
        return float(sum(more.values())), ", ".join(more)

    def character(self, name, clean):
        """A character of the collection, written again: no message that the source hadn't, none with `repair`."""
        source = MOCAP / "gltf" / name
        folder = self.folder / f"valid_{name}"
        folder.mkdir()
        nodes = {"clip": {"type": "Load", "params": {"file": str(source)}}}
        for case, repair in (("as_it_was", False), ("repaired", True)):
            for ending in ("glb", "gltf"):
                nodes[f"{case}_{ending}"] = {"type": "Export", "params": {"file": f"{case}.{ending}", "repair": repair},
                                             "inputs": {"motion": "clip.motion", "character": "clip.character"}}
        self.export(folder.name, json.dumps({"format": "kinegraph", "schema": 1, "nodes": nodes}))
        had, results = self.messages(source), []
        for case, allowed in (("as_it_was", collections.Counter() if clean else had), ("repaired", collections.Counter())):
            for ending in ("glb", "gltf"):
                results.append(Checked(f"valid_{name}.{case}.{ending}", "validator",
                                       *self.validity(folder / f"{case}.{ending}", allowed), 0))
        return results

    def points(self, name, exported, graph, port):
        """A C3D, TRC or table with Y up: against the others of the same points, all read by point_files.py."""
        read = {}
        for ending, reader in point_files.READERS.items():
            file = exported
            if ending != exported.suffix:
                file = exported.with_name(f"{exported.name}{ending}")
                run(self.program, "get", graph, port, "-o", file, "--progress", "none")
            read[ending] = reader(file)
        this = read.pop(exported.suffix)
        height = point_files.extent(this)
        results = []
        for ending, other in read.items():
            worst, where = point_files.largest_difference(this, other)
            results.append(Checked(name, f"as {ending[1:]}", worst / height, where))
        return results

    def analysis(self, name, exported, graph, port):
        """A table or JSON of numbers: it and the other hold the same ones, digit for digit, all of them finite."""
        other = exported.with_name(f"{exported.name}{'.csv' if exported.suffix == '.json' else '.json'}")
        run(self.program, "get", graph, port, "-o", other, "--progress", "none")
        table, json_file = (exported, other) if exported.suffix == ".csv" else (other, exported)
        wrong = point_files.where_analyses_differ(table, json_file)
        return [Checked(name, f"as {other.suffix[1:]}", math.inf if wrong else 0.0, wrong, 0)]


def without_textures(file):
    """Outside a browser three.js can't read pictures: a GLB that has some, without its materials."""
    if file.suffix != ".glb":
        return file
    data = file.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    scene = json.loads(data[20:20 + size])
    if "images" not in scene:
        return file
    for mesh in scene.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    for name in ("images", "textures", "samplers", "materials", "extensionsUsed", "extensionsRequired"):
        scene.pop(name, None)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size:]
    plain = file.with_name(f"{file.stem}.plain.glb")
    plain.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) +
                      struct.pack("<I4s", len(text), b"JSON") + text + rest)
    return plain


def limit_of_blender(places, ours):
    reach = max(math.hypot(*p) for p in places)
    return max(TOLERANCE, BLENDER_BONES * reach / ours["height"])


def difference(ours, theirs):
    """The largest distance as a part of the height, and where, or what else is wrong."""
    if len(theirs["joints"]) != len(ours["joints"]):
        return float("inf"), f"{len(theirs['joints'])} joints, not {len(ours['joints'])}"
    # To Blender an action of a single frame spans two.
    if ours["frames"] != theirs["frames"] and (ours["frames"], theirs["frames"]) != (1, 2):
        return float("inf"), f"{theirs['frames']} frames, not {ours['frames']}"
    # By name; where a client changed names (it may not like blanks or dots) by the file's order.
    at = {name: i for i, name in enumerate(theirs["joints"])}
    names = ours["names"]
    same_names = set(at) == set(names)
    # Kinegraph's own order of a source may be another than that of the file written.
    mine_at = {name: i for i, name in enumerate(ours["joints"])}
    by_name = set(mine_at) == set(names)
    worst, where = 0.0, ""
    for frame, (mine, other) in enumerate(zip(ours["positions"], theirs["positions"])):
        for joint, name in enumerate(names):
            p, q = mine[mine_at[name] if by_name else joint], other[at[name] if same_names else joint]
            far = sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 / ours["height"]
            if not far <= worst:
                worst, where = far, f"{name}, frame {frame}"
    return worst, where


def farthest_vertex(ours, theirs, within=FBX_TOLERANCE):
    """As a part of the height: of each vertex of either side to the nearest of the other, as both may double some."""
    if ours.get("vertices", {}).keys() != theirs["vertices"].keys():
        return float("inf"), "vertices of other frames"
    cell = within * ours["height"]
    worst, where = 0.0, ""
    for frame in theirs["vertices"]:
        a, b = ours["vertices"][frame], theirs["vertices"][frame]
        for some, others in ((a, b), (b, a)):
            grid = collections.defaultdict(list)
            for q in others:
                grid[tuple(round(x / cell) for x in q)].append(q)
            for p in some:
                at = [round(x / cell) for x in p]
                near = [q for step in itertools.product((-1, 0, 1), repeat=3)
                        for q in grid.get(tuple(i + j for i, j in zip(at, step)), ())]
                far = min((sum((x - y) ** 2 for x, y in zip(p, q)) for q in near), default=float("inf")) ** 0.5 / ours["height"]
                if far > worst:
                    worst, where = far, f"frame {frame}"
    return worst, where
