// What is drawn beside the points: the grid map, the camera's path, the cameras.
import * as THREE from "three";
import { blockText } from "./facts.js";

const kEstimate = 0x0fa08b, kTruth = 0xe08a2c, kNow = 0xe23434;
const kMostFrusta = 80, kFrustum_m = 0.11;
const kCells = { 0: [52, 58, 66, 255], 254: [86, 170, 152, 70] };  // occupied, free; unknown is not drawn

export function gridPlane(grid, drawn) {
  const size = [grid.width * grid.resolution_m, grid.height * grid.resolution_m];
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [grid.width, grid.height];
  const texture = new THREE.CanvasTexture(canvas);
  texture.magFilter = THREE.NearestFilter;
  texture.generateMipmaps = false;
  texture.minFilter = THREE.LinearFilter;
  const image = new Image();
  image.onload = () => {
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const picture = context.getImageData(0, 0, grid.width, grid.height);
    for (let i = 0; i < picture.data.length; i += 4) picture.data.set(kCells[picture.data[i]] ?? [0, 0, 0, 0], i);
    context.putImageData(picture, 0, 0);
    texture.needsUpdate = true;
    drawn();
  };
  image.src = `data:image/png;base64,${blockText(grid.block)}`;
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(...size), new THREE.MeshBasicMaterial({ map: texture, transparent: true, side: THREE.DoubleSide, depthWrite: false }));
  plane.position.set(grid.origin_m[0] + size[0] / 2, grid.origin_m[1] + size[1] / 2, 0.005);
  return plane;
}

const line = (points, color) =>
  new THREE.Line(new THREE.BufferGeometry().setFromPoints(points.map((p) => new THREE.Vector3(p[0], p[1], p[2]))), new THREE.LineBasicMaterial({ color }));
export const cameraPath = (trajectory) => line(trajectory.poses, kEstimate);
export const truthPath = (trajectory) => line(trajectory.errors.map((row) => row.slice(1, 4)), kTruth);

/** The edges of what a camera sees, from its centre to a plane before it. */
function edges(sequence, depth) {
  const half = sequence ? [sequence.width / 2 / sequence.fx, sequence.height / 2 / sequence.fy] : [0.6, 0.45];
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => new THREE.Vector3(x * half[0] * depth, y * half[1] * depth, depth));
  const center = new THREE.Vector3();
  return corners.flatMap((corner, i) => [center, corner, corner, corners[(i + 1) % 4]]);
}

/** The cameras of the keyframes; of many every n-th. */
export function frusta(trajectory, sequence) {
  const keyframes = new Set(trajectory.tracking.stamps.filter((_, i) => trajectory.tracking.keyframes[i]));
  let some = trajectory.poses.filter((_, i) => keyframes.has(trajectory.stamps[i]));
  if (!some.length) some = trajectory.poses;
  const every = Math.ceil(some.length / kMostFrusta);
  const points = [], one = edges(sequence, kFrustum_m);
  some.forEach(([x, y, z, qx, qy, qz, qw], i) => {
    if (i % every) return;
    const turn = new THREE.Quaternion(qx, qy, qz, qw), at = new THREE.Vector3(x, y, z);
    for (const point of one) points.push(point.clone().applyQuaternion(turn).add(at));
  });
  return new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({ color: kEstimate, transparent: true, opacity: 0.55 }));
}

/** The camera of the frame that is looked at. */
export const oneFrustum = (sequence) =>
  new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(edges(sequence, 2.2 * kFrustum_m)), new THREE.LineBasicMaterial({ color: kNow }));
