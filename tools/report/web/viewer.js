// Draws an instance's world with three.js. Clouds, octree and trajectory are in the world frame and hang in one group that
// brings them to the frame of the grid map, where z is up.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { blockBytes, frame, mapFromWorld, moved } from "./facts.js";
import { colorsOf, quantile, unpack } from "./points.js";
import { cameraPath, frusta, gridPlane, oneFrustum, truthPath } from "./scene_lines.js";

// Colours are those of the files, to the letter: no conversion on the way.
THREE.ColorManagement.enabled = false;

export class Viewer {
  constructor(place, instance) {
    this.place = place;
    this.instance = instance;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.localClippingEnabled = true;
    place.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xb5b1a8, 2.9));
    const sun = new THREE.DirectionalLight(0xffffff, 1.5);
    sun.position.set(2, 1, 4);
    this.scene.add(sun);
    this.camera = new THREE.PerspectiveCamera(48, 1, 0.02, 500);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.cut = new THREE.Plane(new THREE.Vector3(0, 0, -1), 1e9);
    this.m = mapFromWorld(instance);
    this.world = new THREE.Group();
    this.world.matrixAutoUpdate = false;
    this.world.matrix.set(...this.m, 0, 0, 0, 1);
    this.scene.add(this.world);
    this.parts = new Map();
    this.scale = 1;
    this.addFixed();
    this.measure();
    this.listen();
    this.resize();
    this.view("side");
  }

  addFixed() {
    const { instance } = this;
    if (instance.grid) this.put("grid", gridPlane(instance.grid, () => this.draw()), this.scene);
    if (!instance.trajectory) return;
    this.put("trajectory", cameraPath(instance.trajectory));
    this.put("frusta", frusta(instance.trajectory, instance.sequence));
    if (instance.trajectory.errors) this.put("truth", truthPath(instance.trajectory)).visible = false;
    this.now = this.put("now", oneFrustum(instance.sequence));
  }
  put(name, object, parent = this.world) {
    this.parts.set(name, object);
    parent.add(object);
    return object;
  }

  /** Where things are: the cameras, and the points without the outermost hundredth, so that a stray one does not shrink the rest. */
  measure() {
    const data = this.instance.clouds.length ? this.pointsOf(this.instance.clouds.at(-1)) : this.instance.octree ? this.pointsOf(this.instance.octree) : null;
    if (!data) {
      const poses = this.instance.trajectory?.poses ?? [[0, 0, 0]];
      this.center = new THREE.Vector3(...poses[0]).applyMatrix4(this.world.matrix);
      this.reach = 2;
      this.range = [-1, 2];
      return;
    }
    const { x, y, heights: z } = data;
    const path = (this.instance.trajectory?.poses ?? []).map((pose) => moved(this.m, pose));
    const ends = [x, y, z].map((axis, k) => [
      path.reduce((low, at) => Math.min(low, at[k]), quantile(axis, 0.01)), path.reduce((high, at) => Math.max(high, at[k]), quantile(axis, 0.99))]);
    this.center = new THREE.Vector3(...ends.map(([low, high]) => (low + high) / 2));
    this.reach = Math.max(0.5, Math.hypot(...ends.slice(0, 2).map(([low, high]) => high - low)) / 2);
    this.range = [quantile(z, 0.002), quantile(z, 0.998)];
    this.bounds = [Math.min(0, this.range[0]) - 0.05, this.range[1] + 0.05];
    this.center.z = Math.min(this.center.z, 0.9);
  }
  heights() { return (this.bounds ?? this.range).map((value) => Number(value.toFixed(2))); }
  colorRange() { return this.range; }
  labels() { return this.shown?.labels ?? []; }

  pointsOf(part) {
    this.cache ??= new Map();
    if (!this.cache.has(part)) this.cache.set(part, unpack(part, blockBytes(part.block), this.m));
    return this.cache.get(part);
  }

  /** `what`: the index of a cloud, or "octree"; `color`: image, label or height. */
  show(what, color) {
    const part = what === "octree" ? this.instance.octree : this.instance.clouds[Number(what)];
    for (const name of ["cloud", "octree"]) {
      const old = this.parts.get(name);
      if (old) {
        this.world.remove(old);
        old.geometry.dispose();
        old.material.dispose();
        this.parts.delete(name);
      }
    }
    if (!part) return this.draw();
    this.shown = part;
    const data = this.pointsOf(part), colors = colorsOf(part, data, color, this.range);
    if (what === "octree") this.put("octree", this.boxes(part, data, colors));
    else this.put("cloud", this.cloud(part, data, colors));
    this.draw();
  }

  cloud(part, data, colors) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(data.positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3, true));
    this.spacing = this.spacing ?? 4 * this.reach / Math.sqrt(Math.max(1, data.count));
    const material = new THREE.PointsMaterial({ size: this.spacing * this.scale, vertexColors: true, clippingPlanes: [this.cut] });
    // A point never gets smaller than this, or it would flicker.
    material.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader.replace("#include <logdepthbuf_vertex>", "gl_PointSize = max(gl_PointSize, 1.8);\n#include <logdepthbuf_vertex>");
    };
    return new THREE.Points(geometry, material);
  }

  boxes(part, data, colors) {
    const mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(1, 1, 1), new THREE.MeshLambertMaterial({ clippingPlanes: [this.cut] }), data.count);
    const matrix = new THREE.Matrix4(), color = new THREE.Color();
    for (let i = 0; i < data.count; ++i) {
      const side = part.resolution_m * 2 ** data.levels[i] * 0.97;
      matrix.makeScale(side, side, side).setPosition(data.positions[3 * i], data.positions[3 * i + 1], data.positions[3 * i + 2]);
      mesh.setMatrixAt(i, matrix);
      mesh.setColorAt(i, color.setRGB(colors[3 * i] / 255, colors[3 * i + 1] / 255, colors[3 * i + 2] / 255));
    }
    mesh.frustumCulled = false;
    return mesh;
  }

  toggle(name, on) {
    const part = this.parts.get(name);
    if (part) part.visible = on;
    if (name === "frusta" && this.now) this.now.visible = on;
    this.draw();
  }
  cutAbove(height) {
    this.cut.constant = Number.isFinite(height) ? height : 1e9;
    this.draw();
  }
  pointSize(scale) {
    this.scale = scale;
    const cloud = this.parts.get("cloud");
    if (cloud) cloud.material.size = this.spacing * scale;
    this.draw();
  }

  view(from) {
    const { center, reach } = this;
    const distance = 0.98 * reach / Math.tan(this.camera.fov * Math.PI / 360) * Math.max(1, 1 / this.camera.aspect);
    this.controls.target.copy(center);
    if (from === "top") this.camera.position.set(center.x, center.y - 0.001 * distance, center.z + 1.05 * distance);
    else if (from === "camera" && this.now?.position) {
      const at = new THREE.Vector3().setFromMatrixPosition(this.now.matrixWorld);
      this.camera.position.copy(at);
      this.controls.target.copy(new THREE.Vector3(0, 0, 1.2).applyMatrix4(this.now.matrixWorld));
    } else this.camera.position.set(...this.sideOf(distance));
    this.controls.update();
    this.draw();
  }
  /** From behind the cameras: what they looked at faces the viewer. */
  sideOf(distance) {
    const { center } = this;
    const poses = this.instance.trajectory?.poses ?? [];
    let angle = -Math.PI / 3;
    if (poses.length) {
      const middle = poses[Math.floor(poses.length / 2)];
      const at = new THREE.Vector3(...middle).applyMatrix4(this.world.matrix);
      if (Math.hypot(at.x - center.x, at.y - center.y) > 0.2 * this.reach) angle = Math.atan2(at.y - center.y, at.x - center.x);
    }
    const up = 0.62;
    return [center.x + distance * Math.cos(up) * Math.cos(angle + 0.35), center.y + distance * Math.cos(up) * Math.sin(angle + 0.35), center.z + distance * Math.sin(up)];
  }

  listen() {
    const { place } = this;
    new ResizeObserver(() => this.resize()).observe(place);
    place.addEventListener("keydown", (event) => this.key(event));
    const themed = () => (place.isConnected ? this.draw() : document.removeEventListener("themechange", themed));
    document.addEventListener("themechange", themed);
    frame.onchange((stamp) => this.follow(stamp));
    if (frame.stamp) this.follow(frame.stamp);
  }
  follow(stamp) {
    const i = this.instance.trajectory?.stamps.indexOf(stamp) ?? -1;
    if (i < 0 || !this.now) return;
    const [x, y, z, qx, qy, qz, qw] = this.instance.trajectory.poses[i];
    this.now.position.set(x, y, z);
    this.now.quaternion.set(qx, qy, qz, qw);
    this.now.updateMatrixWorld(true);
    this.draw();
  }
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const round = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
    const step = 0.06 * round.radius;
    const ahead = new THREE.Vector3(-offset.x, -offset.y, 0).normalize(), side = new THREE.Vector3(ahead.y, -ahead.x, 0);
    const shift = { w: ahead, s: ahead.clone().negate(), d: side, a: side.clone().negate() }[event.key.toLowerCase()];
    if (shift) {
      this.camera.position.addScaledVector(shift, step);
      this.controls.target.addScaledVector(shift, step);
    } else if (event.key === "ArrowLeft") round.theta -= 0.08;
    else if (event.key === "ArrowRight") round.theta += 0.08;
    else if (event.key === "ArrowUp") round.phi = Math.max(0.02, round.phi - 0.06);
    else if (event.key === "ArrowDown") round.phi = Math.min(3.1, round.phi + 0.06);
    else if (event.key === "+" || event.key === "=") round.radius *= 0.9;
    else if (event.key === "-") round.radius /= 0.9;
    else if (event.key.toLowerCase() === "t") return this.view("top");
    else if (event.key.toLowerCase() === "r") return this.view("side");
    else return;
    event.preventDefault();
    if (!shift) {
      const turned = new THREE.Vector3().setFromSpherical(round);
      this.camera.position.copy(this.controls.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    }
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  /** At the next picture; once, however often it is asked for. */
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (!this.place.isConnected) return this.renderer.dispose();
      this.scene.background = new THREE.Color(getComputedStyle(this.place).backgroundColor);
      this.renderer.render(this.scene, this.camera);
      this.place.dataset.drawn = String(Number(this.place.dataset.drawn ?? 0) + 1);
    });
  }
}
