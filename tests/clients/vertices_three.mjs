// World positions of every vertex of a GLB file's characters, as three.js poses them.
//
//   node vertices_three.mjs FILE OUT.json FPS EVERY     (in a folder with three in its node_modules)
//
// OUT.json as of vertices_blender.py.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [file, out, fps, every] = process.argv.slice(2);
const base = pathToFileURL(path.join(process.cwd(), 'node_modules/three/')).href;
const THREE = await import(base + 'build/three.module.js');
const { GLTFLoader } = await import(base + 'examples/jsm/loaders/GLTFLoader.js');
const bytes = fs.readFileSync(file);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const gltf = await new GLTFLoader().parseAsync(buffer, '');
const clip = gltf.animations[0];
const meshes = [];
gltf.scene.traverse((o) => { if (o.isMesh) meshes.push(o); });
const mixer = new THREE.AnimationMixer(gltf.scene);
const action = mixer.clipAction(clip);
action.setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
const vertices = {};
const p = new THREE.Vector3();
for (let frame = 0; frame <= Math.round(clip.duration * fps); frame += Number(every)) {
  mixer.setTime(Math.min(frame / fps, clip.duration));
  gltf.scene.updateMatrixWorld(true);
  const points = vertices[frame] = [];
  for (const mesh of meshes)
    for (let i = 0; i < mesh.geometry.attributes.position.count; ++i) {
      mesh.getVertexPosition(i, p).applyMatrix4(mesh.matrixWorld);
      points.push([p.x, p.y, p.z]);
    }
}
fs.writeFileSync(out, JSON.stringify({ vertices }));
