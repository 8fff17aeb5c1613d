// One throw in three dimensions: lines and discs on a canvas, seen with a pinhole camera that
// orbits the vehicle. World: z up.
'use strict';

class Camera {
  constructor() {
    this.target = [0, 0, 1];
    this.distance = 5;
    this.azimuth = -2.3;
    this.elevation = 0.35;
  }

  // Prepares project() for a canvas of this size.
  aim(width, height) {
    const [ca, sa] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const [ce, se] = [Math.cos(this.elevation), Math.sin(this.elevation)];
    const away = [ce * ca, ce * sa, se];
    this.eye = this.target.map((x, i) => x + this.distance * away[i]);
    this.right = [-sa, ca, 0];
    this.up = [-se * ca, -se * sa, ce];
    this.forward = away.map((x) => -x);
    this.f = 1.1 * Math.min(width, 1.4 * height);
    this.middle = [width / 2, height / 2];
  }

  // [x, y, pixels per metre], or null behind the camera.
  project(p) {
    const d = p.map((x, i) => x - this.eye[i]);
    const depth = dot(d, this.forward);
    if (depth < 0.05) return null;
    const scale = this.f / depth;
    return [this.middle[0] + scale * dot(d, this.right),
            this.middle[1] - scale * dot(d, this.up), scale];
  }
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function rotated([w, x, y, z], v) {
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
          v[2] + w * t[2] + x * t[1] - y * t[0]];
}

class View3d {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.camera = new Camera();
    this.trajectory = null;
    this.t_s = 0;
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  // Makes the picture as large as the flight until `until_s` allows.
  show(trajectory, until_s) {
    this.trajectory = trajectory;
    const first = trajectory.samples[0];
    const samples = trajectory.samples.filter((s) => s === first || s.t_s <= until_s);
    const points = samples.flatMap((s) => [s.p, ...s.objects.filter(Boolean)]);
    const middle = [0, 1, 2].map((i) => {
      const values = points.map((p) => p[i]);
      return (Math.min(...values) + Math.max(...values)) / 2;
    });
    const reach = Math.max(...points.map((p) => Math.hypot(...p.map((x, i) => x - middle[i]))));
    this.camera.target = middle;
    this.camera.distance = Math.max(1.5, 2.6 * reach);
    this.floor = middle;
    // From behind the vehicle, to the side.
    const ahead = rotated(first.q, [1, 0, 0]);
    this.camera.azimuth = Math.atan2(-ahead[1], -ahead[0]) + 0.7;
    this.camera.elevation = 0.35;
    this.t_s = first.t_s;
    this.draw();
  }

  seek(t_s) {
    this.t_s = t_s;
    this.draw();
  }

  listen() {
    const canvas = this.canvas;
    let grip = null;
    const turn = (dx, dy) => {
      this.camera.azimuth -= dx;
      this.camera.elevation = Math.min(1.5, Math.max(-0.3, this.camera.elevation + dy));
      this.draw();
    };
    const zoom = (factor) => {
      this.camera.distance = Math.min(40, Math.max(0.5, this.camera.distance * factor));
      this.draw();
    };
    canvas.addEventListener('pointerdown', (e) => {
      grip = [e.clientX, e.clientY];
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener('pointermove', (e) => {
      if (!grip) return;
      turn((e.clientX - grip[0]) * 0.008, (e.clientY - grip[1]) * 0.008);
      grip = [e.clientX, e.clientY];
    });
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, () => { grip = null; });
    }
    canvas.addEventListener('wheel', (e) => {
      e.preventDefault();
      zoom(Math.exp(0.001 * e.deltaY));
    }, {passive: false});
    canvas.addEventListener('keydown', (e) => {
      const turns = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1],
                     ArrowDown: [0, -0.1]};
      if (turns[e.key]) turn(...turns[e.key]);
      else if (e.key === '+') zoom(0.9);
      else if (e.key === '-') zoom(1 / 0.9);
      else return;
      e.preventDefault();
    });
  }

  colour(name) {
    return getComputedStyle(this.canvas).getPropertyValue('--' + name);
  }

  line(points, colour, width, alpha = 1) {
    const c = this.context;
    c.strokeStyle = colour;
    c.globalAlpha = alpha;
    c.lineWidth = width;
    c.beginPath();
    let started = false;
    for (const p of points) {
      const at = p && this.camera.project(p);
      if (!at) {
        started = false;
        continue;
      }
      if (started) c.lineTo(at[0], at[1]);
      else c.moveTo(at[0], at[1]);
      started = true;
    }
    c.stroke();
    c.globalAlpha = 1;
  }

  disc(p, radius_m, colour, leastPx = 2) {
    const at = this.camera.project(p);
    if (!at) return;
    const c = this.context;
    const radius = Math.max(leastPx, radius_m * at[2]);
    const shade = c.createRadialGradient(at[0] - 0.4 * radius, at[1] - 0.4 * radius, 0.1 * radius,
                                         at[0], at[1], radius);
    shade.addColorStop(0, '#fff');
    shade.addColorStop(0.35, colour);
    shade.addColorStop(1, colour);
    c.fillStyle = shade;
    c.beginPath();
    c.arc(at[0], at[1], radius, 0, 2 * Math.PI);
    c.fill();
  }

  draw() {
    const canvas = this.canvas;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !height) return;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    if (!this.trajectory || !this.trajectory.samples.length) return;
    this.camera.aim(width, height);
    this.drawFloor();
    this.drawPaths();
    this.drawDetections();
    this.drawNow(sampleAt(this.trajectory, this.t_s));
  }

  // A grid of 1 m on the floor.
  drawFloor() {
    const colour = this.colour('faint');
    const [x0, y0] = [Math.round(this.floor[0]), Math.round(this.floor[1])];
    const reach = 4;
    for (let i = -reach; i <= reach; ++i) {
      this.line([[x0 + i, y0 - reach, 0], [x0 + i, y0 + reach, 0]], colour, 1);
      this.line([[x0 - reach, y0 + i, 0], [x0 + reach, y0 + i, 0]], colour, 1);
    }
  }

  drawPaths() {
    const samples = this.trajectory.samples;
    const vehicle = this.colour('vehicle');
    const object = this.colour('object');
    const past = samples.filter((s) => s.t_s <= this.t_s);
    this.line(samples.map((s) => s.p), vehicle, 1.5, 0.35);
    this.line(past.map((s) => s.p), vehicle, 2.5);
    for (let k = 0; k < this.trajectory.sizes_m.length; ++k) {
      this.line(samples.map((s) => s.objects[k]), object, 1.5, 0.35);
      this.line(past.map((s) => s.objects[k]), object, 2.5);
    }
    // Where the shadow of each would fall shows its place over the floor.
    const shadow = (p) => p && [p[0], p[1], 0];
    this.line(past.map((s) => shadow(s.p)), this.colour('muted'), 1, 0.6);
    for (let k = 0; k < this.trajectory.sizes_m.length; ++k) {
      this.line(past.map((s) => shadow(s.objects[k])), this.colour('muted'), 1, 0.6);
    }
  }

  drawDetections() {
    const c = this.context;
    for (const detection of this.trajectory.detections) {
      if (detection.t_s > this.t_s) break;
      const at = this.camera.project(detection.p);
      if (!at) continue;
      c.strokeStyle = this.colour(detection.real ? 'detection' : 'bad');
      c.lineWidth = 1.6;
      const r = 4;
      c.beginPath();
      if (detection.real) {
        c.moveTo(at[0] - r, at[1]);
        c.lineTo(at[0] + r, at[1]);
        c.moveTo(at[0], at[1] - r);
        c.lineTo(at[0], at[1] + r);
      } else {
        c.rect(at[0] - r, at[1] - r, 2 * r, 2 * r);
      }
      c.stroke();
    }
  }

  drawNow(now) {
    const far = [...now.objects.entries()].filter(([, p]) => p);
    const depth = (p) => dot(p.map((x, i) => x - this.camera.eye[i]), this.camera.forward);
    const draws = far.map(([k, p]) => [depth(p), () => {
      this.line([p, [p[0], p[1], 0]], this.colour('muted'), 1, 0.6);
      this.disc(p, this.trajectory.sizes_m[k] / 2, this.colour('object'));
    }]);
    draws.push([depth(now.p), () => this.drawVehicle(now)]);
    for (const [, draw] of draws.sort((a, b) => b[0] - a[0])) draw();
  }

  drawVehicle(now) {
    const at = (v) => rotated(now.q, v).map((x, i) => x + now.p[i]);
    const colour = this.colour('vehicle');
    this.line([now.p, [now.p[0], now.p[1], 0]], this.colour('muted'), 1, 0.6);
    // A sketch in the size of qav_rxl, whatever the vehicle.
    const rotors = [[0.085, 0.1], [0.085, -0.1], [-0.085, -0.1], [-0.085, 0.1]];
    for (const [x, y] of rotors) {
      this.line([at([0, 0, 0]), at([x, y, 0.01])], colour, 3);
      const circle = Array.from({length: 17}, (_, i) => {
        const angle = (2 * Math.PI * i) / 16;
        return at([x + 0.0762 * Math.cos(angle), y + 0.0762 * Math.sin(angle), 0.02]);
      });
      this.line(circle, colour, 1.5);
    }
    this.line([at([0, 0, 0]), at([0.14, 0, 0])], this.colour('text'), 3);
    this.drawCommand(now);
  }

  // 1 m of arrow for 5 m/s.
  drawCommand(now) {
    const speed = Math.hypot(...now.command);
    if (speed < 0.05) return;
    const tip = now.p.map((x, i) => x + 0.2 * now.command[i]);
    const colour = this.colour(now.evading ? 'command' : 'muted');
    this.line([now.p, tip], colour, 3);
    const a = this.camera.project(now.p);
    const b = this.camera.project(tip);
    if (!a || !b) return;
    const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
    const c = this.context;
    c.fillStyle = colour;
    c.beginPath();
    c.moveTo(b[0] + 6 * Math.cos(angle), b[1] + 6 * Math.sin(angle));
    for (const turn of [2.4, -2.4]) {
      c.lineTo(b[0] + 8 * Math.cos(angle + turn), b[1] + 8 * Math.sin(angle + turn));
    }
    c.fill();
  }
}
