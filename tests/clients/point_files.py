"""C3D, TRC and tables of points, read by the letter of their formats: no client program that Debian or npm has reads them.

Each reader gives (names, rate, rows): rows[frame][name] is (x, y, z) in metres as the file has its axes, or None where
the marker is missing.
"""
import csv
import itertools
import json
import math
import struct

METRES = {"m": 1, "cm": 0.01, "mm": 0.001, "in": 0.0254}


def read_trc(path):
    lines = path.read_text(encoding="utf-8").split("\n")
    said = dict(zip(lines[1].split("\t"), lines[2].split("\t")))
    names = [name for name in lines[3].split("\t")[2:] if name]
    unit = METRES[said["Units"]]
    if int(said["NumMarkers"]) != len(names):
        raise RuntimeError(f"{path}: NumMarkers is {said['NumMarkers']}, {len(names)} are named")
    rows = []
    for line in lines[5:]:
        cells = line.split("\t")
        if len(cells) < 2:
            continue
        if int(cells[0]) != len(rows) + 1 or abs(float(cells[1]) * float(said["DataRate"]) - len(rows)) > 0.01:
            raise RuntimeError(f"{path}: frame {cells[0]} at {cells[1]} s is not number {len(rows) + 1}")
        values = cells[2:]
        if len(values) != 3 * len(names):
            raise RuntimeError(f"{path}: {len(values)} values in frame {cells[0]}")
        rows.append({name: None if not values[3 * i] else tuple(unit * float(x) for x in values[3 * i:3 * i + 3])
                     for i, name in enumerate(names)})
    if len(rows) != int(said["NumFrames"]):
        raise RuntimeError(f"{path}: NumFrames is {said['NumFrames']}, the file has {len(rows)}")
    return names, float(said["DataRate"]), rows


def read_table(path):
    with path.open(newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    names = [column[:-2] for column in header[2::3]]
    if header != ["frame", "time", *(f"{name}.{axis}" for name in names for axis in "xyz")]:
        raise RuntimeError(f"{path}: the header is not frame, time and three columns a point")
    rows = [{name: None if not line[2 + 3 * i] else tuple(float(x) for x in line[2 + 3 * i:5 + 3 * i])
             for i, name in enumerate(names)} for line in lines]
    rate = (len(lines) - 1) / (float(lines[-1][1]) - float(lines[0][1])) if len(lines) > 1 else 0
    return names, rate, rows


def read_c3d(path):
    """Intel's byte order and real coordinates, as C3D is written here."""
    data = path.read_bytes()
    first_block, magic, points, _, first, last, _, scale, start, analog, rate = struct.unpack_from("<BBHHHHHfHHf", data)
    if magic != 0x50 or scale >= 0:
        raise RuntimeError(f"{path}: no C3D with real coordinates")
    parameters = {}
    at, groups = 512 * (first_block - 1) + 4, {}
    while True:
        length, group = struct.unpack_from("<bb", data, at)
        if length == 0:
            break
        name = data[at + 2:at + 2 + abs(length)].decode()
        offset_at = at + 2 + abs(length)
        offset, = struct.unpack_from("<h", data, offset_at)
        if group < 0:
            groups[-group] = name
        else:
            kind, dimensions = struct.unpack_from("<bB", data, offset_at + 2)
            parameters[group, name] = (kind, data[offset_at + 4:offset_at + 4 + dimensions], offset_at + 4 + dimensions)
        if offset == 0:
            break
        at = offset_at + offset

    def of_points(name):
        return parameters[next(k for k, group in groups.items() if group == "POINT"), name]

    def texts(name):
        _, sizes, place = of_points(name)
        width, count = sizes[0], math.prod(sizes[1:])
        return [data[place + i * width:place + (i + 1) * width].decode().rstrip() for i in range(count)]

    names, k = texts("LABELS"), 2
    while ("LABELS" + str(k)) in {name for _, name in parameters}:
        names += texts("LABELS" + str(k))
        k += 1
    names = names[:points]
    unit = METRES[texts("UNITS")[0]]
    frames = last - first + 1
    place = 512 * (start - 1)
    rows = []
    for frame in range(frames):
        row = {}
        for i, name in enumerate(names):
            x, y, z, residual = struct.unpack_from("<4f", data, place + 16 * (frame * points + i))
            row[name] = None if residual < 0 else (unit * x, unit * y, unit * z)
        rows.append(row)
    return names, rate, rows


READERS = {".trc": read_trc, ".csv": read_table, ".c3d": read_c3d}


def largest_difference(a, b):
    """(The largest distance in metres of a point of two such files, its height in metres; where)."""
    (names, rate, rows), (others, other_rate, other_rows) = a, b
    if names != others or len(rows) != len(other_rows) or abs(rate / other_rate - 1) > 1e-6:
        return math.inf, f"{len(others)} points, {len(other_rows)} frames at {other_rate:g}"
    worst, where = 0.0, ""
    for frame, (row, other) in enumerate(zip(rows, other_rows)):
        for name in names:
            p, q = row[name], other[name]
            far = math.dist(p, q) if p and q else 0 if p is q else math.inf
            if not far <= worst:
                worst, where = far, f"{name}, frame {frame}"
    return worst, where


def extent(points):
    _, _, rows = points
    places = [p for row in rows for p in row.values() if p]
    return max(max(p[i] for p in places) - min(p[i] for p in places) for i in range(3))


def no_number(word):
    raise RuntimeError(f"{word} in JSON")


def where_analyses_differ(table, json_file):
    """Where a table and the JSON of the same components, metrics or contacts hold different numbers; "" where none."""
    with table.open(newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    said = json.loads(json_file.read_text(encoding="utf-8"), parse_constant=no_number)
    if said["format"] == "kinegraph-components":
        wanted = [[str(u[i]) for u in said["signals"]] for i in range(len(said["signals"][0]))]
        if header != ["frame", "segment", *(f"u{i + 1}" for i in range(len(said["signals"])))]:
            return f"the header {header}"
        lines = [line[2:] for line in lines]
    elif said["format"] == "kinegraph-metrics":
        wanted = [[one["name"], str(one["value"]), one["unit"]] for one in said["metrics"]]
    elif said["format"] == "kinegraph-contacts":
        if header[2:] != [f"{point['foot']}.{point['part']}" for point in said["points"]]:
            return f"the header {header}"
        wanted = [[str(int(any(start <= frame < end for start, end in point["planted"]))) for point in said["points"]]
                  for frame in range(said["frames"])]
        lines = [line[2:] for line in lines]
    else:
        return f"nothing is known of {said['format']}"

    def value(cell):
        try:
            return float(cell)
        except ValueError:
            return cell
    for i, (line, want) in enumerate(itertools.zip_longest(lines, wanted)):
        if line is None or want is None or list(map(value, line)) != list(map(value, want)):
            return f"row {i}: {line} and {want}"
    return ""
