"use strict";
// The scenes of a replay: one for each trial, drawn by three.js, posed at any time by the animation of the GLB file.
const replayScene = (() => {
  const FINGERS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
  const LONGEST_ARROW_M = 0.22;
  const TOUCH = "#e6007e";
  const TOUCH_ARROW_M = 0.16;
  const PATH_RADIUS_M = 0.003;
  const VIEWS = {
    overview: { azimuth: 215, elevation: 22 },
    hand: { azimuth: 235, elevation: 12, distance: 0.75, follows: true },
    side: { azimuth: 270, elevation: 6 },
    top: { azimuth: 270, elevation: 89 },
  };
  // What moves is looked at in so many instants; bodies are in the picture as far as they are so near to it, in its size.
  const INSTANTS = 16, NEAR = 0.1, AROUND = 0.5, BELOW = 0.05;
  const BORDER = 1.04;
  // Least angle of the line of sight to the vertical, by keys.
  const STEEPEST = 0.02;

  const library = () => {
    if (typeof THREE === "undefined") {
      const held = Array.from(document.querySelectorAll("script.held")).find((one) => one.textContent.startsWith("/* three.js"));
      const script = document.createElement("script");
      script.textContent = held.textContent;
      document.head.append(script);
    }
    return THREE;
  };

  const bytesOf = (text) => Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const unpacked = async (text) => {
    const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  };

  // The index of the last sample that is not after a time.
  const sampleAt = (times, time) => {
    let low = 0, high = times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle] <= time + 2e-6) low = middle; else high = middle - 1;
    }
    return low;
  };

  // The index of the phase at a time, the last one after the end; -1 without motion.
  const phaseAt = (phases, time) => phases.reduce((found, one, place) => one.start_s !== null && time >= one.start_s - 1e-9 ? place : found, -1);

  class Trial {
    constructor(gltf, glb, timeline) {
      const three = library();
      this.glb = glb;
      this.timeline = timeline;
      this.scene = new three.Scene();
      this.group = gltf.scene;
      this.world = gltf.scene.getObjectByName("world");
      this.scene.add(this.group, ...lights());
      this.mixer = new three.AnimationMixer(this.group);
      for (const clip of gltf.animations) {
        const action = this.mixer.clipAction(clip);
        action.setLoop(three.LoopOnce);
        action.clampWhenFinished = true;
        action.play();
      }
      this.kinds = { body: [], link: [], object: [], perceived: [], path: [], graph: [] };
      this.group.traverse((node) => {
        if (node.userData.kind in this.kinds) this.kinds[node.userData.kind].push(node);
        if (node.isMesh) { node.castShadow = node.receiveShadow = !node.material.transparent; }
      });
      for (const line of this.kinds.path) thicken(line);
      for (const line of this.kinds.graph) line.material = Object.assign(line.material.clone(), { transparent: true, opacity: 0.55 });
      this.hand = this.kinds.link.find((node) => node.name.startsWith("gripper_base")) || this.kinds.link[this.kinds.link.length - 1];
      this.arrows = timeline.contacts.map((_, finger) => arrow(FINGERS[finger % FINGERS.length]));
      this.touches = timeline.touches.map(() => onTop(arrow(TOUCH)));
      for (const one of [...this.arrows, ...this.touches]) this.world.add(one);
      this.pose(timeline.start_s);
    }

    pose(time) {
      const { timeline } = this;
      const at = Math.min(Math.max(time, timeline.start_s), timeline.end_s);
      this.mixer.setTime(at);
      const sample = sampleAt(timeline.time_s, at);
      this.pointArrows(sample);
      this.pointTouches(at);
      const phase = timeline.phases[phaseAt(timeline.phases, at)];
      for (const line of [...this.kinds.path, ...this.kinds.graph]) {
        line.userData.current = phase !== undefined && line.userData.phase === phase.key;
      }
      this.showLines();
    }

    pointArrows(sample) {
      this.arrows.forEach((one, finger) => {
        const { points_m: points, forces_n: forces } = this.timeline.contacts[finger];
        const point = points[sample], force = forces[sample];
        one.visible = this.showsForces !== false && point !== null;
        if (one.visible) aim(one, point, force, LONGEST_ARROW_M * Math.hypot(...force) / this.timeline.greatest_force_n);
      });
    }

    // What is no grip: arrows of one length, since such a force is of another scale. What ended the trial began after the last sample.
    pointTouches(time) {
      this.touches.forEach((one, at) => {
        const { start_s: start, end_s: end, point_m: point, force_n: force } = this.timeline.touches[at];
        const began = Math.min(start, this.timeline.end_s);
        one.visible = this.showsForces !== false && time >= began - 1e-6 && time <= end && Math.hypot(...force) > 0;
        if (one.visible) aim(one, point, force, TOUCH_ARROW_M);
      });
    }

    showLines() {
      // Only the planner's tree of the current phase is shown: all at once hide the robot.
      for (const line of this.kinds.path) { line.visible = this.showsPath !== false; line.userData.tube.opacity = line.userData.current ? 1 : 0.3; }
      for (const line of this.kinds.graph) line.visible = this.showsGraph !== false && line.userData.current;
    }

    show(what, on) {
      if (what === "forces") this.showsForces = on;
      if (what === "path") this.showsPath = on;
      if (what === "graph") this.showsGraph = on;
      if (what === "perceived") for (const node of this.kinds.perceived) node.visible = on;
    }

    // The ghost of the second trial: transparent, and without the fixed bodies.
    beGhost(on) {
      for (const node of this.kinds.body) node.visible = !on;
      for (const kind of ["link", "object"]) for (const top of this.kinds[kind]) top.traverse((node) => {
        if (!node.isMesh) return;
        node.userData.solid = node.userData.solid || node.material;
        node.material = on ? Object.assign(node.userData.solid.clone(), { transparent: true, opacity: 0.32, depthWrite: false }) : node.userData.solid;
        node.castShadow = !on;
      });
    }

    // Corners of what the camera has in the picture: what moves in the trial, and what it stands on or passes.
    framed() {
      const three = library(), { start_s: start, end_s: end } = this.timeline;
      const shown = this.mixer.time;
      const boxOf = (node) => {
        const box = new three.Box3().setFromObject(node);
        return box.isEmpty() ? box : box.applyMatrix4(this.world.matrixWorld.clone().invert());
      };
      const moving = new three.Box3();
      for (let at = 0; at <= INSTANTS; at += 1) {
        this.mixer.setTime(start + (end - start) * at / INSTANTS);
        this.group.updateMatrixWorld(true);
        for (const node of [...this.kinds.link, ...this.kinds.object]) moving.union(boxOf(node));
      }
      this.mixer.setTime(shown);
      this.group.updateMatrixWorld(true);
      const size = moving.getSize(new three.Vector3()).length();
      const flat = (share) => new three.Vector3(share * size, share * size, 0);
      const near = moving.clone().expandByVector(flat(NEAR)), around = moving.clone().expandByVector(flat(AROUND));
      near.min.z = around.min.z = moving.min.z - BELOW * size;
      near.max.z = around.max.z = Infinity;
      const boxes = [moving, ...this.kinds.body.map(boxOf).filter((box) => box.intersectsBox(near)).map((box) => box.intersect(around))];
      const corners = boxes.flatMap(({ min, max }) => [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new three.Vector3(x, y, z)))));
      return corners.map((corner) => this.world.localToWorld(corner));
    }

    placeOf(node) { return node.getWorldPosition(new (library()).Vector3()); }
  }

  const lights = () => {
    const three = library();
    const sun = new three.DirectionalLight(0xffffff, 2.1);
    sun.position.set(-2, 4, 1.2);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    Object.assign(sun.shadow.camera, { left: -2.5, right: 2.5, top: 2.5, bottom: -2.5, near: 0.5, far: 9 });
    sun.shadow.normalBias = 0.02;
    return [sun, new three.HemisphereLight(0xffffff, 0x8d8a84, 1.5)];
  };

  // A line of one pixel is hard to see; a path becomes a thin tube.
  const thicken = (line) => {
    const three = library();
    const positions = line.geometry.getAttribute("position");
    const points = Array.from({ length: positions.count }, (_, at) => new three.Vector3().fromBufferAttribute(positions, at));
    const lengths = points.map(() => 0);
    points.forEach((point, at) => { if (at > 0) lengths[at] = lengths[at - 1] + point.distanceTo(points[at - 1]); });
    const total = lengths[lengths.length - 1];
    if (!(total > 0)) { line.userData.tube = line.material; return; }
    class Course extends three.Curve {
      getPoint(share, target = new three.Vector3()) {
        const at = Math.max(1, lengths.findIndex((length) => length >= share * total - 1e-12));
        const span = lengths[at] - lengths[at - 1];
        return target.lerpVectors(points[at - 1], points[at], span > 0 ? (share * total - lengths[at - 1]) / span : 0);
      }
      getPointAt(share, target) { return this.getPoint(share, target); }
    }
    const material = new three.MeshBasicMaterial({ color: line.material.color, transparent: true });
    const tube = new three.Mesh(new three.TubeGeometry(new Course(), Math.min(400, 3 * points.length), PATH_RADIUS_M, 6), material);
    line.userData.tube = material;
    line.geometry = new three.BufferGeometry();
    line.add(tube);
  };

  // Lets the tip of an arrow end where the force acts.
  const aim = (one, point, force, length) => {
    const three = library();
    const along = new three.Vector3(...force).normalize();
    one.position.set(...point).addScaledVector(along, -length);
    one.quaternion.setFromUnitVectors(new three.Vector3(0, 1, 0), along);
    const head = Math.min(0.03, 0.4 * length);
    one.userData.shaft.scale.set(1, Math.max(1e-4, length - head), 1);
    one.userData.head.position.y = Math.max(0, length - head);
    one.userData.head.scale.set(1, Math.max(1e-4, head), 1);
  };

  const arrow = (colour) => {
    const three = library();
    const group = new three.Group();
    const material = new three.MeshBasicMaterial({ color: colour });
    const shaft = new three.Mesh(new three.CylinderGeometry(0.0045, 0.0045, 1, 12).translate(0, 0.5, 0), material);
    const head = new three.Mesh(new three.ConeGeometry(0.012, 1, 16).translate(0, 0.5, 0), material);
    group.add(shaft, head);
    Object.assign(group.userData, { shaft, head });
    return group;
  };

  // The force on a link comes out of the body that it touches, which would hide the arrow.
  const onTop = (one) => {
    for (const part of [one.userData.shaft, one.userData.head]) { part.renderOrder = 1; part.material.depthTest = false; part.material.transparent = true; }
    return one;
  };

  class View {
    // One renderer for all trials, which share a camera.
    constructor(place, trials, { onDraw = () => {} } = {}) {
      const three = library();
      this.place = place;
      this.trials = trials;
      this.mode = "ghost";
      this.onDraw = onDraw;
      this.renderer = new three.WebGLRenderer({ antialias: true });
      this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
      this.renderer.shadowMap.enabled = true;
      this.renderer.shadowMap.type = three.PCFSoftShadowMap;
      this.renderer.autoClear = false;
      place.prepend(this.renderer.domElement);
      this.renderer.domElement.setAttribute("aria-hidden", "true");
      this.camera = new three.PerspectiveCamera(36, 1, 0.02, 40);
      this.controls = new three.OrbitControls(this.camera, place);
      this.controls.minDistance = 0.1;
      this.controls.maxDistance = 10;
      this.controls.addEventListener("change", () => this.redraw());
      this.controls.addEventListener("start", () => { this.turned = true; });
      // A page is scrolled over the scene; the wheel zooms once the reader is in it.
      place.addEventListener("wheel", (event) => { if (!place.contains(document.activeElement)) event.stopImmediatePropagation(); }, { capture: true });
      this.follows = false;
      this.turned = false;
      this.name = "overview";
      this.arrange(this.mode);
      new ResizeObserver(() => this.resize()).observe(place);
    }

    arrange(mode) {
      this.mode = this.trials.length > 1 ? mode : "one";
      const [first, second] = this.trials;
      if (second !== undefined) {
        const ghost = this.mode === "ghost";
        (ghost ? first : second).scene.add(second.group);
        second.beGhost(ghost);
      }
      this.resize();
      this.choose(this.name);
    }

    choose(name) {
      this.turned = false;
      const three = library();
      const { azimuth, elevation, distance, follows = false } = VIEWS[name];
      const turn = azimuth * Math.PI / 180, rise = elevation * Math.PI / 180;
      const [first] = this.trials;
      const towards = new three.Vector3(Math.cos(rise) * Math.cos(turn), Math.cos(rise) * Math.sin(turn), Math.sin(rise));
      const turned = towards.applyQuaternion(first.world.getWorldQuaternion(new three.Quaternion()));
      const target = follows ? first.placeOf(first.hand) : new three.Vector3();
      // In a narrow picture the camera is farther away, so that the width of the hand fits.
      if (follows) this.camera.position.copy(target).addScaledVector(turned, distance * Math.max(1, 1 / this.camera.aspect));
      else this.fit(turned, target);
      this.controls.target.copy(target);
      this.name = name;
      this.follows = follows;
      this.followed = target;
      this.controls.update();
      this.redraw();
    }

    // The nearest place of the camera, in a direction from the scene, that has all corners in the picture; its target.
    fit(turned, target) {
      const three = library();
      const ahead = turned.clone().negate();
      const right = new three.Vector3().crossVectors(ahead, this.camera.up).normalize();
      const up = new three.Vector3().crossVectors(right, ahead);
      this.corners = this.corners || this.trials.flatMap((trial) => trial.framed());
      const tall = Math.tan(this.camera.fov * Math.PI / 360) / BORDER, wide = tall * this.camera.aspect;
      const depths = this.corners.map((corner) => corner.dot(ahead));
      // A corner is in the picture if |across - c| <= slope * (depth - d), with the camera at c across and d ahead.
      const between = (axis, slope) => {
        const across = this.corners.map((corner) => corner.dot(axis));
        const least = Math.max(...across.map((one, at) => one - slope * depths[at])), most = Math.min(...across.map((one, at) => one + slope * depths[at]));
        return { middle: (least + most) / 2, depth: (most - least) / (2 * slope) };
      };
      const [h, v] = [between(right, wide), between(up, tall)];
      const depth = Math.min(h.depth, v.depth);
      this.camera.position.set(0, 0, 0).addScaledVector(right, h.middle).addScaledVector(up, v.middle).addScaledVector(ahead, depth);
      const far = (Math.min(...depths) + Math.max(...depths)) / 2 - depth;
      target.copy(this.camera.position).addScaledVector(ahead, far);
    }

    // Turns the camera about its target by degrees to the right and up, and multiplies its distance.
    orbit(right, up, closer = 1) {
      const three = library(), { up: vertical } = this.camera, { target, minDistance, maxDistance } = this.controls;
      const from = this.camera.position.clone().sub(target).applyAxisAngle(vertical, right * Math.PI / 180);
      const across = new three.Vector3().crossVectors(vertical, from).normalize();
      const angle = from.angleTo(vertical), risen = Math.min(Math.PI - STEEPEST, Math.max(STEEPEST, angle - up * Math.PI / 180));
      from.applyAxisAngle(across, risen - angle).setLength(Math.min(maxDistance, Math.max(minDistance, from.length() * closer)));
      this.camera.position.copy(target).add(from);
      this.turned = true;
      this.controls.update();
      this.redraw();
    }

    pose(time) {
      for (const trial of this.trials) trial.pose(time);
      if (this.follows) {
        this.trials[0].group.updateMatrixWorld(true);
        const now = this.trials[0].placeOf(this.trials[0].hand);
        this.camera.position.add(now).sub(this.followed);
        this.controls.target.add(now).sub(this.followed);
        this.followed = now;
        this.controls.update();
      }
      this.redraw();
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.place;
      if (width === 0 || height === 0) return;
      this.renderer.setSize(width, height);
      this.camera.aspect = (this.mode === "beside" ? width / 2 : width) / height;
      this.camera.updateProjectionMatrix();
      // A view that the reader has not turned fits the new shape of the picture.
      if (!this.turned && this.followed) this.choose(this.name);
      this.redraw();
    }

    redraw() {
      if (this.waiting) return;
      this.waiting = true;
      requestAnimationFrame(() => { this.waiting = false; this.draw(); });
    }

    draw() {
      const three = library();
      const { clientWidth: width, clientHeight: height } = this.place;
      const sky = new three.Color(getComputedStyle(document.documentElement).getPropertyValue("--sky").trim());
      const beside = this.mode === "beside";
      this.renderer.setScissorTest(true);
      (beside ? this.trials : this.trials.slice(0, 1)).forEach((trial, place) => {
        const share = beside ? Math.floor(width / 2) : width;
        trial.scene.background = sky;
        this.renderer.setViewport(place * share, 0, share, height);
        this.renderer.setScissor(place * share, 0, share, height);
        this.renderer.clear();
        this.renderer.render(trial.scene, this.camera);
      });
      this.onDraw();
    }
  }

  // Where nothing can be drawn in three dimensions, the phases and the plots of a replay are there nevertheless.
  class NoView {
    constructor(place, error) {
      const note = document.createElement("p");
      note.className = "replay-absent";
      note.setAttribute("role", "alert");
      note.textContent = `This browser draws nothing in three dimensions (${error.message}). Time, phases and plots are shown all the same.`;
      place.append(note);
    }

    arrange() {}
    choose() {}
    orbit() {}
    pose() {}
    redraw() {}
  }

  const load = async (data) => {
    const three = library();
    const [glb, text] = await Promise.all([".replay-model", ".replay-timeline"].map((one) => unpacked(data.querySelector(one).textContent)));
    const timeline = JSON.parse(new TextDecoder().decode(text));
    const gltf = await new three.GLTFLoader().parseAsync(glb, "");
    return new Trial(gltf, glb, timeline);
  };

  return { View, NoView, load, phaseAt, sampleAt, views: Object.keys(VIEWS) };
})();
