// The campaign's data, and what the reader has chosen to see of it.
'use strict';

const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId('data').textContent);

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// A column of numbers, one a throw; little-endian as written.
function column(name) {
  const {type, values} = data.columns[name];
  const buffer = bytesOf(values).buffer;
  return new {f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array}[type](buffer);
}

const throws = Object.fromEntries(Object.keys(data.columns).map((name) => [name, column(name)]));
const count = throws.number.length;
const kNone = 255;
const has = (i, flag) => (throws.flags[i] & data.flags[flag]) !== 0;
const fateOf = (i) => data.fates[throws.fate[i]];

// What the reader has chosen: a value of the sweep, a pilot, a cell {text, has: (i) => boolean} and
// which throws are listed.
const state = {section: 0, pilot: 0, cell: null, filter: 'all', page: 0, chosen: -1};
const section = () => data.sections[state.section];
const indices = () => Array.from({length: count}, (_, i) => i)
    .filter((i) => throws.sweep[i] === section().sweep);

// What a rate of a pilot counts: of the reference none, the throws that would have hit.
const rateName = ({role, name}) => (role === 'none' ? 'would have hit' : `dodged by ${name}`);
const pilotName = ({role, name}) => (role === 'none' ? 'none: would have hit' : name);
const pilotOf = (part, role) => part.pilots.find((p) => p.role === role);

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

const number = (x, digits = 2) => (Number.isFinite(x) ? x.toFixed(digits) : '-');
