"""Runs scripts for Blender one after the other in one Blender, which takes longer to start than most of them need:

    blender -b --factory-startup --python blender_worker.py

A line of standard input is JSON, [SCRIPT, WORD...]: SCRIPT runs as `blender ... --python SCRIPT -- WORD...` would. When
it ends, a line of standard output is "done " and JSON: null, or how it failed.
"""
import json
import runpy
import sys
import traceback

for line in sys.stdin:
    script, *words = json.loads(line)
    sys.argv = ["blender", "--", *words]
    failed = None
    try:
        runpy.run_path(script, run_name="__main__")
    except (Exception, SystemExit):
        failed = traceback.format_exc()
    print("\ndone " + json.dumps(failed), flush=True)
