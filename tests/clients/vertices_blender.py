"""World positions of every vertex of a glTF file's characters, as Blender poses them.

    blender -b --factory-startup --python-exit-code 3 --python vertices_blender.py -- FILE OUT.json FPS EVERY

OUT.json: {"vertices": {frame: [[x, y, z]]}}, every so many frames, metres, Y up.
"""
import json
import sys

import bpy
import numpy

numpy.bool = bool  # Debian 12's glTF importer still uses it
import addon_utils

path, out, fps, every = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
addon_utils.enable("io_scene_gltf2")
scene = bpy.context.scene
scene.render.fps = round(float(fps))
bpy.ops.import_scene.gltf(filepath=path)
armatures = [o for o in bpy.data.objects if o.type == "ARMATURE"]
shapes = {bone.custom_shape for a in armatures for bone in a.pose.bones}  # which the importer draws bones with
meshes = [o for o in scene.objects if o.type == "MESH" and o not in shapes]
# Of a mesh without a skeleton its shape keys are what moves.
moving = [a for a in armatures if a.animation_data] or [o.data.shape_keys for o in meshes if o.data.shape_keys]
first, last = (round(v) for v in moving[0].animation_data.action.frame_range)
vertices = {}
for frame in range(first, last + 1, int(every)):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    points = vertices[frame - first] = []
    for mesh in meshes:
        posed = mesh.evaluated_get(graph)
        for vertex in posed.data.vertices:
            p = posed.matrix_world @ vertex.co
            points.append([p.x, p.z, -p.y])  # Blender's Z up back to Y up
with open(out, "w") as file:
    json.dump({"vertices": vertices}, file)
