// Fills the page from the data of one campaign.
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

function outcomeOf(i) {
  if (has(i, 'failed')) return 'failed';
  if (has(i, 'hit')) return 'hit';
  if (has(i, 'crashed')) return 'crashed';
  if (!has(i, 'thrown')) return has(i, 'evaded') ? 'false alarm' : 'quiet';
  return has(i, 'none_hit') ? 'dodged' : 'would have missed';
}

// Part of the page that follows the choice of a sweep value, and of throws.
const state = {section: 0, pilot: 0, cell: null, filter: 'all', page: 0, chosen: -1};
const section = () => data.sections[state.section];
const indices = () => Array.from({length: count}, (_, i) => i)
    .filter((i) => throws.sweep[i] === section().sweep);

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

const number = (x, digits = 2) => (Number.isFinite(x) ? x.toFixed(digits) : '-');

function fillHead() {
  byId('title').textContent = data.title;
  byId('description').textContent = data.description;
  byId('stop').textContent = data.stop;
  const facts = [['Pilot', data.pilot], ['Throws', `${count} of ${data.wanted}`],
                 ['Seed', data.seed], ['Program', data.program]];
  for (const [term, value] of facts) {
    byId('provenance').append(make('dt', {textContent: term}), make('dd', {textContent: value}));
  }
  if (data.sections.length < 2) return;
  byId('sweep-choice').hidden = false;
  data.sections.forEach((s, k) => byId('sweep').append(new Option(s.label, k)));
  byId('sweep').addEventListener('change', () => {
    Object.assign(state, {section: Number(byId('sweep').value), cell: null, filter: 'all', page: 0});
    fillSection();
  });
}

function fillFigures() {
  const figures = section().pilots.map((p) => [
    p.name === 'none' ? 'would have hit' : `dodged by ${p.name}`, p.total]);
  figures.push(['detected, of those in view', section().detected],
               ['false alarms', section().false_alarms]);
  byId('figures').replaceChildren(...figures.map(([name, rate]) => make('div',
      {className: 'figure', title: rateText(rate)}, make('span', {textContent: name}),
      make('b', {textContent: number(rateOf(rate))}),
      make('span', {className: 'muted',
                    textContent: rate[1] ? `${rate[0]} of ${rate[1]}; ${intervalText(rate)}` :
                                             'no throws'}))));
}

function fillHeat() {
  const pilots = section().pilots;
  byId('pilots').replaceChildren(...pilots.map((pilot, k) => {
    const button = make('button', {type: 'button', textContent: pilot.name});
    button.setAttribute('aria-pressed', k === state.pilot);
    button.addEventListener('click', () => {
      state.pilot = k;
      fillHeat();
      byId('pilots').children[k].focus();
    });
    return button;
  }));
  const rates = pilots[state.pilot].cells;
  byId('heat').replaceChildren(!rates.length ? empty('Nobody threw.') : heatMap({
    rows: data.sizes, columns: data.distances, rates, rowUnit: 'm', columnUnit: 'm',
    press: (i, j) => {
      state.cell = [i, j];
      choose('cell');
    },
  }));
}

function fillCurves() {
  const pilots = section().pilots.filter((p) => p.name !== 'none' || section().pilots.length === 1);
  byId('speed').replaceChildren(!data.speeds.length ? empty('Nobody threw.') : rateCurves({
    series: pilots.map((p) => ({name: p.name,
                                points: p.by_speed.map((rate, k) => [data.speeds[k], rate])})),
    xLabel: 'speed [m/s]', label: 'Rate of dodged throws over speed'}));
  // A curve over the sweep, if its values are numbers.
  const at = data.sections.map((s) => Number(s.value));
  if (at.length < 2 || !data.sweep_key || !at.every(Number.isFinite)) return;
  byId('sweep-section').hidden = false;
  const overall = pilots.map((p, k) => ({
    name: p.name, points: data.sections.map((s, i) => [at[i], s.pilots[k].total])}));
  const ofSpeed = data.speeds.length < 2 || data.speeds.length > 5 ? [] :
      data.speed_texts.map((speed, j) => ({
        name: `${data.pilot}, ${speed} m/s`,
        points: data.sections.map((s, i) => [at[i], s.pilots[0].by_speed[j]])}));
  byId('sweep-curve').replaceChildren(rateCurves({
    series: [...overall, ...ofSpeed], xLabel: data.sweep_key,
    label: `Rate of dodged throws over ${data.sweep_key}`}));
}

function fillHistograms() {
  const mine = indices();
  const dangerous = mine.filter((i) => has(i, 'none_hit'));
  const values = (name, of = mine) => of.map((i) => throws[name][i]);
  const pilot = section().pilots[0].name;
  const clearances = [{name: pilot, values: values('clearance', dangerous)}];
  if (mine.some((i) => has(i, 'oracle_flew'))) {
    clearances.push({name: 'oracle', values: values('oracle_clearance', dangerous)});
  }
  byId('clearance').replaceChildren(histogram({
    series: clearances, most: 2, xLabel: 'smallest distance of the surfaces [m]; 0 is a hit',
    label: 'Clearances of throws that would have hit'}));
  byId('range').replaceChildren(histogram({
    series: [{name: pilot, values: values('detection_distance')}], most: 20,
    xLabel: 'true distance at the first detection [m]', label: 'Detection range'}));
  byId('contact').replaceChildren(histogram({
    series: [{name: pilot, values: values('contact')}], most: 3,
    xLabel: 'time left, had it not dodged [s]', label: 'Time to contact at the first detection'}));
  byId('speedup').replaceChildren(
      make('p', {textContent: `${number(data.real_time_factor)} simulated seconds in a second of ` +
          'one core, over the whole campaign.'}),
      histogram({series: [{name: pilot, values: values('real_time_factor')}], most: 1000,
                 xLabel: 'simulated time / computing time, by throw', label: 'Real-time factor'}));
}

function fillCauses() {
  const rows = data.causes.map((cause, k) => ({
    cause, of: indices().filter((i) => throws.cause[i] === k)})).filter((row) => row.of.length);
  if (!rows.length) {
    byId('causes').replaceChildren(empty('No throw hit, and nothing crashed.'));
    return;
  }
  const most = Math.max(...rows.map((row) => row.of.length));
  byId('causes').replaceChildren(...rows.map(({cause, of}) => {
    const fill = make('div', {className: 'fill'});
    fill.style.width = `${(100 * of.length) / most}%`;
    const all = make('button', {type: 'button', textContent: cause});
    all.addEventListener('click', () => choose(cause));
    const some = of.slice(0, 16).map((i) => {
      const button = make('button', {type: 'button', textContent: throws.number[i]});
      button.setAttribute('aria-label', `Throw ${throws.number[i]}`);
      button.addEventListener('click', () => open(i, true));
      return button;
    });
    if (of.length > some.length) some.push(make('span', {className: 'muted', textContent: '...'}));
    return make('div', {className: 'bar-row'}, all, make('b', {textContent: of.length}),
                make('div', {className: 'track'}, fill), make('div', {className: 'throws'}, ...some));
  }));
}

// The list of throws.

const kPage = 15;
const kColumns = [
  ['throw', (i) => throws.number[i]],
  ['outcome', (i) => outcomeOf(i), 'text'],
  ['size', (i) => number(throws.size[i])],
  ['distance', (i) => number(throws.distance[i], 1)],
  ['speed', (i) => number(throws.speed[i], 1)],
  ['clearance', (i) => number(throws.clearance[i])],
  ['cause', (i) => (throws.cause[i] === kNone ? '' : data.causes[throws.cause[i]]), 'text'],
];

function passes(i) {
  if (state.filter === 'all') return true;
  if (state.filter === 'cell') {
    return throws.size_bin[i] === state.cell[0] && throws.distance_bin[i] === state.cell[1];
  }
  return outcomeOf(i) === state.filter || data.causes[throws.cause[i]] === state.filter ||
      (state.filter === 'false alarm' && has(i, 'false_alarm'));
}

function fillList() {
  const mine = indices().filter(passes);
  const pages = Math.max(1, Math.ceil(mine.length / kPage));
  state.page = Math.min(state.page, pages - 1);
  const shown = mine.slice(state.page * kPage, (state.page + 1) * kPage);
  byId('filtered').textContent = `${mine.length} throws`;
  byId('page').textContent = `page ${state.page + 1} of ${pages}`;
  byId('before').disabled = state.page === 0;
  byId('after').disabled = state.page + 1 === pages;
  byId('list').replaceChildren(...shown.map((i) => {
    const row = make('tr', {}, ...kColumns.map(([, text, kind]) => make('td',
        {textContent: text(i), className: kind || ''})));
    row.setAttribute('aria-selected', i === state.chosen);
    return pressable(row, `Throw ${throws.number[i]}, ${outcomeOf(i)}`, () => open(i, true));
  }));
}

function choose(filter) {
  Object.assign(state, {filter, page: 0});
  fillFilters();
  fillList();
  byId('filter').scrollIntoView({block: 'center', behavior: 'smooth'});
}

function fillFilters() {
  const outcomes = new Set(indices().map(outcomeOf));
  const causes = data.causes.filter((_, k) => indices().some((i) => throws.cause[i] === k));
  const options = [new Option('all throws', 'all'), ...[...outcomes].sort().map((o) => new Option(o, o)),
                   ...causes.map((c) => new Option(`cause: ${c}`, c))];
  if (indices().some((i) => has(i, 'false_alarm')) && !outcomes.has('false alarm')) {
    options.push(new Option('false alarm', 'false alarm'));
  }
  if (state.cell) {
    options.push(new Option(`${data.sizes[state.cell[0]]} m from ${data.distances[state.cell[1]]} m`,
                            'cell'));
  }
  byId('filter').replaceChildren(...options);
  byId('filter').value = state.filter;
}

// The throw in 3-D.

const view = new View3d(byId('view'));
let clock = null;  // of the animation

// The bytes of one throw, cut from the base64 text of all.
function trackOf(i) {
  const [at, size] = [throws.track_at[i], throws.track_size[i]];
  const first = Math.floor(at / 3);
  const text = tracks.slice(4 * first, 4 * Math.ceil((at + size) / 3));
  return bytesOf(text).subarray(at - 3 * first, at - 3 * first + size);
}
const tracks = byId('tracks').textContent;

function storyOf(i) {
  if (has(i, 'failed')) return data.errors[throws.number[i]] || 'The simulation failed.';
  if (!has(i, 'thrown')) return outcomeOf(i);
  const parts = [`${data.objects[throws.object[i]]} of ${number(throws.size[i])} m from ` +
                 `${number(throws.distance[i], 1)} m at ${number(throws.speed[i], 1)} m/s: ` +
                 outcomeOf(i)];
  if (throws.cause[i] !== kNone) parts.push(`, ${data.causes[throws.cause[i]]}`);
  if (Number.isFinite(throws.left[i])) {
    parts.push(`. The evasive command came ${number(throws.left[i], 3)} s before the contact; ` +
               `the vehicle needs ${number(throws.needed[i], 3)} s at least`);
  }
  return parts.join('') + '.';
}

function open(i, scroll) {
  state.chosen = i;
  stop();
  byId('throw-title').textContent = `Throw ${throws.number[i]}`;
  byId('throw-story').textContent = storyOf(i);
  byId('replay').textContent = `${data.replay}${throws.number[i]} --video throw${throws.number[i]}.mp4`;
  byId('number').value = throws.number[i];
  history.replaceState(null, '', `#throw=${throws.number[i]}`);
  fillList();
  const known = throws.track_size[i] > 0;
  byId('view').hidden = !known;
  byId('play').disabled = byId('time').disabled = !known;
  byId('moments').replaceChildren();
  if (known) showTrack(i);
  if (scroll) byId('viewer').scrollIntoView({block: 'nearest', behavior: 'smooth'});
}

function showTrack(i) {
  const trajectory = readTrajectory(trackOf(i));
  const closest = throws.closest[i];
  // What flies on after it has passed is not worth the room.
  view.show(trajectory, Number.isFinite(closest) ? closest + 0.15 : Infinity);
  const samples = trajectory.samples;
  const [start, end] = [samples[0].t_s, samples[samples.length - 1].t_s];
  Object.assign(byId('time'), {min: start, max: end});
  const moments = [['launch', throws.launch[i]], ['in view', throws.in_view[i]],
                   ['detected', throws.detected[i]], ['command', throws.command[i]],
                   Number.isFinite(throws.hit[i]) ? ['hit', throws.hit[i]] :
                                                    ['closest', throws.closest[i]]];
  for (const [name, t_s] of moments) {
    if (!Number.isFinite(t_s)) continue;
    const button = make('button', {type: 'button', textContent: `${name} ${number(t_s, 3)} s`});
    button.addEventListener('click', () => {
      stop();
      seek(t_s);
    });
    byId('moments').append(button);
  }
  seek(Number.isFinite(closest) ? closest : end);
}

function seek(t_s) {
  byId('time').value = t_s;
  byId('clock').textContent = `${number(t_s, 3)} s`;
  view.seek(t_s);
}

function stop() {
  if (clock !== null) cancelAnimationFrame(clock);
  clock = null;
  byId('play').textContent = 'Play';
}

// Four times slower than the flight.
function play() {
  const time = byId('time');
  let t_s = Number(time.value);
  if (t_s >= Number(time.max) - 1e-3) t_s = Number(time.min);
  let last = null;
  byId('play').textContent = 'Pause';
  const step = (now) => {
    if (last !== null) t_s += (now - last) / 4000;
    last = now;
    seek(Math.min(t_s, Number(time.max)));
    if (t_s >= Number(time.max)) stop();
    else clock = requestAnimationFrame(step);
  };
  clock = requestAnimationFrame(step);
}

function fillSection() {
  fillFigures();
  fillHeat();
  fillCurves();
  fillHistograms();
  fillCauses();
  fillFilters();
  fillList();
}

function openNumber(text) {
  const i = throws.number.indexOf(Number(text));
  if (i < 0) return false;
  if (throws.sweep[i] !== section().sweep) {
    state.section = data.sections.findIndex((s) => s.sweep === throws.sweep[i]);
    byId('sweep').value = state.section;
    fillSection();
  }
  open(i, false);
  return true;
}

function listen() {
  byId('filter').addEventListener('change', () => {
    Object.assign(state, {filter: byId('filter').value, page: 0});
    fillList();
  });
  byId('number').addEventListener('change', () => openNumber(byId('number').value));
  for (const [id, step] of [['before', -1], ['after', 1]]) {
    byId(id).addEventListener('click', () => {
      state.page += step;
      fillList();
    });
  }
  byId('time').addEventListener('input', () => {
    stop();
    seek(Number(byId('time').value));
  });
  byId('play').addEventListener('click', () => (clock === null ? play() : stop()));
  byId('copy').addEventListener('click', async () => {
    const code = byId('replay');
    try {
      await navigator.clipboard.writeText(code.textContent);
      byId('copy').textContent = 'Copied';
    } catch {
      // A page from a file may not write to the clipboard: select the line instead.
      getSelection().selectAllChildren(code);
    }
  });
  window.addEventListener('hashchange', openHash);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => view.draw());
}

function openHash() {
  const wanted = /^#throw=(\d+)$/.exec(location.hash);
  return wanted ? openNumber(wanted[1]) : false;
}

fillHead();
byId('list-head').append(make('tr', {}, ...kColumns.map(([name, , kind]) => make('th',
    {textContent: name, className: kind || '', scope: 'col'}))));
fillSection();
listen();
if (!openHash() && count) {
  // The first that was dodged, else the first that flew.
  const order = Array.from({length: count}, (_, i) => i);
  const first = order.find((i) => outcomeOf(i) === 'dodged' && throws.track_size[i]) ??
      order.find((i) => throws.track_size[i]) ?? 0;
  open(first, false);
}
document.documentElement.dataset.ready = 'true';
