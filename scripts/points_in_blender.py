"""Brings Points into Blender: an empty for each, keyed at every frame where it isn't missing.

    kinegraph convert clip.trc clip.csv
    blender --python scripts/points_in_blender.py -- clip.csv

Blender reads no TRC and no C3D; CSV holds the same numbers, in metres with Y up. Blender's Z is up.
"""
import csv
import sys

import bpy


def points_from(path):
    rows = list(csv.reader(open(path)))
    labels = [name[:-2] for name in rows[0][2::3]]
    if len(rows) > 2:
        bpy.context.scene.render.fps = round(1 / (float(rows[2][1]) - float(rows[1][1])))
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 0, max(len(rows) - 2, 0)
    for i, label in enumerate(labels):
        empty = bpy.data.objects.new(label, None)
        empty.empty_display_size = 0.01
        bpy.context.collection.objects.link(empty)
        for row in rows[1:]:
            place = row[2 + 3 * i : 5 + 3 * i]
            if all(place):
                x, y, z = map(float, place)
                empty.location = (x, -z, y)
                empty.keyframe_insert("location", frame=int(row[0]))


points_from(sys.argv[-1])
