// Reads what sim/outcome/trajectory.cc writes.
'use strict';

class ByteReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  // Up to 53 bits; multiplies where << would stop at 32.
  count() {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      if (this.at >= this.bytes.length) throw new Error('A trajectory is not whole.');
      const byte = this.bytes[this.at++];
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  }

  difference(predicted) {
    return predicted.map((p) => {
      const zigzag = this.count();
      return p + (zigzag % 2 ? -(zigzag + 1) / 2 : zigzag / 2);
    });
  }
}

// A row of positions, each predicted from the two before it.
class Motion {
  constructor() {
    this.last = null;
    this.velocity = [0, 0, 0];
  }

  read(reader) {
    const predicted = this.last ? this.last.map((x, i) => x + this.velocity[i]) : [0, 0, 0];
    const at = reader.difference(predicted);
    if (this.last) this.velocity = at.map((x, i) => x - this.last[i]);
    this.last = at;
    return at.map((x) => x * 1e-3);
  }
}

function quaternion(x, y, z) {
  const w = Math.sqrt(Math.max(0, 1 - x * x - y * y - z * z));
  const norm = Math.hypot(w, x, y, z);
  return [w / norm, x / norm, y / norm, z / norm];
}

// {sizes_m, samples: [{t_s, p, q, command, evading, objects}], detections: [{t_s, p, real}]}
function readTrajectory(bytes) {
  const reader = new ByteReader(bytes);
  const tickS = 250e-6;
  const startS = reader.count() * tickS;
  const periodS = reader.count() * tickS;
  const endS = startS + reader.count() * tickS;
  const sizes_m = Array.from({length: reader.count()}, () => reader.count() * 1e-3);
  const vehicle = new Motion();
  const objects = sizes_m.map(() => new Motion());
  let attitude = [0, 0, 0];
  let command = [0, 0, 0];
  const samples = [];
  const sampleCount = reader.count();
  for (let i = 0; i < sampleCount; ++i) {
    const head = reader.count();
    const sample = {t_s: Math.min(startS + i * periodS, endS), evading: head % 2 === 1};
    sample.p = vehicle.read(reader);
    attitude = reader.difference(attitude);
    sample.q = quaternion(...attitude.map((x) => x * 0.01));
    if (Math.floor(head / 2) % 2 === 0) command = reader.difference(command);
    sample.command = command.map((x) => x * 0.1);
    sample.objects = objects.map((motion, k) =>
        Math.floor(head / 2 ** (k + 2)) % 2 === 1 ? motion.read(reader) : null);
    samples.push(sample);
  }
  const detections = [];
  let at = [0, 0, 0];
  let ms = Math.floor(startS * 1000 + 1e-6);
  const detectionCount = reader.count();
  for (let i = 0; i < detectionCount; ++i) {
    const head = reader.count();
    ms += Math.floor(head / 2);
    at = reader.difference(at);
    detections.push({t_s: ms * 1e-3, p: at.map((x) => x * 0.01), real: head % 2 === 1});
  }
  return {sizes_m, samples, detections};
}

// The sample at any time, linear between its neighbours.
function sampleAt(trajectory, t_s) {
  const samples = trajectory.samples;
  let i = 0;
  while (i + 1 < samples.length && samples[i + 1].t_s <= t_s) ++i;
  const a = samples[i];
  const b = samples[Math.min(i + 1, samples.length - 1)];
  const share = b.t_s > a.t_s ? Math.min(1, Math.max(0, (t_s - a.t_s) / (b.t_s - a.t_s))) : 0;
  const mixed = (u, v) => u.map((x, k) => x + share * (v[k] - x));
  return {
    t_s,
    p: mixed(a.p, b.p),
    q: quaternion(...mixed(a.q, b.q).slice(1)),
    command: a.command,
    evading: a.evading,
    objects: a.objects.map((p, k) => (p && b.objects[k] ? mixed(p, b.objects[k]) : p)),
  };
}
