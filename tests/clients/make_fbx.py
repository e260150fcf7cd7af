"""An FBX written by Blender, and where Blender has its joints and vertices, in metres and Y up:

    blender -b --factory-startup --python-exit-code 3 --python make_fbx.py -- FILE.bvh|FILE.glb OUT.fbx OUT.json [AXIS_UP]

OUT.json: {"joints": [names], "frames": n, "fps": f, "positions": [frame][joint][x, y, z],
"vertices": {frame: [[x, y, z]]}} (some frames of the skinned mesh, where there is one). AXIS_UP: Y (default) or Z.
Lengths of a BVH are taken as centimetres.
"""
import builtins
import json
import sys

import bpy
import numpy

numpy.bool = bool  # Debian 12's glTF importer still uses it
import addon_utils

source, fbx, out, *rest = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
addon_utils.enable("io_scene_fbx")
if source.lower().endswith(".bvh"):
    import io_anim_bvh.import_bvh as importer
    importer.open = lambda f, mode="r", *a, **k: builtins.open(f, mode.replace("U", ""), *a, **k)
    bpy.ops.import_anim.bvh(filepath=source, global_scale=0.01, rotate_mode="QUATERNION", axis_forward="-Z", axis_up="Y",
                            update_scene_fps=True, update_scene_duration=True)
else:
    addon_utils.enable("io_scene_gltf2")
    scene.render.fps = 24
    bpy.ops.import_scene.gltf(filepath=source)
fps = scene.render.fps / scene.render.fps_base

armature = next(o for o in bpy.data.objects if o.type == "ARMATURE")
first, last = (round(v) for v in armature.animation_data.action.frame_range)
scene.frame_start, scene.frame_end = first, last
meshes = [o for o in bpy.data.objects if o.type == "MESH" and any(m.type == "ARMATURE" for m in o.modifiers)]


def y_up(v):
    return [v.x, v.z, -v.y]


positions, vertices = [], {}
for frame in range(first, last + 1):
    scene.frame_set(frame)
    positions.append([y_up(armature.matrix_world @ b.head) for b in armature.pose.bones])
    if meshes and (frame - first) % 7 == 0:
        graph = bpy.context.evaluated_depsgraph_get()
        vertices[frame - first] = [y_up(o.matrix_world @ v.co) for o in (m.evaluated_get(graph) for m in meshes)
                                   for v in o.data.vertices]
up = rest[0] if rest else "Y"
bpy.ops.export_scene.fbx(filepath=fbx, use_selection=False, object_types={"ARMATURE", "MESH"}, add_leaf_bones=False,
                         bake_anim=True, bake_anim_simplify_factor=0.0, bake_anim_use_all_actions=False,
                         bake_anim_use_nla_strips=False, axis_up=up, axis_forward="-Z" if up == "Y" else "Y")
with builtins.open(out, "w") as to:
    json.dump({"joints": [b.name for b in armature.pose.bones], "frames": len(positions), "fps": fps,
               "positions": positions, "vertices": vertices}, to)
