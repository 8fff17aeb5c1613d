// Fills the page.
'use strict';

function fillHead() {
  byId('title').textContent = data.title;
  byId('description').textContent = data.description;
  byId('stop').textContent = data.stop;
  byId('losses').textContent = data.losses;
  const pilots = new Set(data.sections.map((s) => pilotOf(s, 'flown').name));
  const facts = [['Pilot', [...pilots].join(', ')], ['Throws', `${count} of ${data.wanted}`],
                 ['Seed', data.seed], ['Program', data.program]];
  for (const [term, value] of facts) {
    byId('provenance').append(make('dt', {textContent: term}), make('dd', {textContent: value}));
  }
  if (data.sections.length < 2) return;
  byId('sweep-choice').hidden = false;
  data.sections.forEach((s, k) => byId('sweep').append(new Option(s.label, k)));
  byId('sweep').addEventListener('change', () => chooseSection(Number(byId('sweep').value)));
}

function chooseSection(k) {
  Object.assign(state, {section: k, pilot: 0, cell: null, filter: 'all', page: 0});
  byId('sweep').value = k;
  fillSection();
}

function fillFigures() {
  const figures = section().pilots.map((p) => [rateName(p), p.total]);
  figures.push(['detected, of those in view', section().detected],
               ['false alarms', section().false_alarms]);
  byId('figures').replaceChildren(...figures.map(([name, rate]) => make('div',
      {className: 'figure', title: rateText(rate)}, make('span', {textContent: name}),
      make('b', {textContent: number(rateOf(rate))}),
      make('span', {className: 'muted',
                    textContent: rate[1] ? `${rate[0]} of ${rate[1]}; ${intervalText(rate)}` :
                                             'no throws'}))));
}

function fillHistograms() {
  const mine = indices();
  const dangerous = mine.filter((i) => has(i, 'none_hit'));
  const values = (name, of = mine) => of.map((i) => throws[name][i]);
  const pilot = pilotOf(section(), 'flown').name;
  const clearances = [{name: pilot, values: values('clearance', dangerous)}];
  if (pilotOf(section(), 'oracle')) {
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
    byId('causes').replaceChildren(empty(pilotOf(section(), 'flown').name === 'none' ?
        'The pilot none does nothing about a throw, so no cause is told.' :
        'No throw hit, and nothing crashed.'));
    return;
  }
  const losses = rows.reduce((sum, row) => sum + row.of.length, 0);
  byId('causes').replaceChildren(...rows.map(({cause, of}) => {
    const fill = make('div', {className: 'fill'});
    fill.style.width = `${(100 * of.length) / losses}%`;
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

// Why throws or flights failed.
function fillErrors() {
  const wrong = indices().filter((i) => data.errors[throws.number[i]]);
  byId('errors-section').hidden = !wrong.length;
  const nobodys = wrong.filter((i) => fateOf(i) === 'not flown').length;
  const counts = [];
  if (nobodys) counts.push(`Throws that no pilot could fly, which no rate counts: ${nobodys}.`);
  if (wrong.length > nobodys) {
    const others = wrong.length - nobodys;
    counts.push(`Throws of which a flight failed, which is no success of that pilot: ${others}.`);
  }
  const some = wrong.slice(0, 12).map((i) => {
    const button = make('button', {type: 'button', textContent: `Throw ${throws.number[i]}`});
    button.addEventListener('click', () => open(i, true));
    return make('p', {}, button, ` ${data.errors[throws.number[i]]}`);
  });
  if (wrong.length > some.length) some.push(make('p', {className: 'muted', textContent: '...'}));
  byId('errors').replaceChildren(make('p', {textContent: counts.join(' ')}), ...some);
}

// The list of throws.

const kPage = 15;
const ofThrow = (i, value, digits) => number(has(i, 'thrown') ? value : NaN, digits);
const kColumns = [
  ['throw', (i) => throws.number[i]],
  ['outcome', (i) => fateOf(i), 'text'],
  ['size [m]', (i) => ofThrow(i, throws.size[i])],
  ['distance [m]', (i) => ofThrow(i, throws.distance[i], 1)],
  ['speed [m/s]', (i) => ofThrow(i, throws.speed[i], 1)],
  ['clearance [m]', (i) => number(throws.clearance[i])],
  ['cause', (i) => (throws.cause[i] === kNone ? '' : data.causes[throws.cause[i]]), 'text'],
];

function passes(i) {
  if (state.filter === 'all') return true;
  if (state.filter === 'cell') return state.cell.has(i);
  return fateOf(i) === state.filter || data.causes[throws.cause[i]] === state.filter ||
      (state.filter === 'false alarm' && has(i, 'false_alarm'));
}

function fillList() {
  const mine = indices().filter(passes);
  const pages = Math.max(1, Math.ceil(mine.length / kPage));
  state.page = Math.min(state.page, pages - 1);
  const shown = mine.slice(state.page * kPage, (state.page + 1) * kPage);
  byId('filtered').textContent = `${mine.length} ${mine.length === 1 ? 'throw' : 'throws'}`;
  byId('page').textContent = `page ${state.page + 1} of ${pages}`;
  byId('before').disabled = state.page === 0;
  byId('after').disabled = state.page + 1 === pages;
  byId('list').replaceChildren(...shown.map((i) => {
    const row = make('tr', {}, ...kColumns.map(([, text, kind]) => make('td',
        {textContent: text(i), className: kind || ''})));
    row.setAttribute('aria-selected', i === state.chosen);
    return pressable(row, `Throw ${throws.number[i]}, ${fateOf(i)}`, () => open(i, true));
  }));
}

function choose(filter) {
  Object.assign(state, {filter, page: 0});
  fillFilters();
  fillList();
  byId('filter').scrollIntoView({block: 'center', behavior: 'smooth'});
}

function chooseCell(text, has) {
  state.cell = {text, has};
  choose('cell');
}

function fillFilters() {
  const outcomes = new Set(indices().map(fateOf));
  const causes = data.causes.filter((_, k) => indices().some((i) => throws.cause[i] === k));
  const options = [new Option('all throws', 'all'), ...[...outcomes].sort().map((o) => new Option(o, o)),
                   ...causes.map((c) => new Option(`cause: ${c}`, c))];
  if (indices().some((i) => has(i, 'false_alarm')) && !outcomes.has('false alarm')) {
    options.push(new Option('false alarm', 'false alarm'));
  }
  if (state.cell) options.push(new Option(state.cell.text, 'cell'));
  byId('filter').replaceChildren(...options);
  byId('filter').value = state.filter;
}

function fillSection() {
  fillFigures();
  fillHeat();
  fillCells();
  fillSpeed();
  fillHistograms();
  fillCauses();
  fillErrors();
  fillFilters();
  fillList();
}

function openNumber(text) {
  const i = text.trim() === '' ? -1 : throws.number.indexOf(Number(text));
  if (i < 0) return false;
  if (throws.sweep[i] !== section().sweep) {
    chooseSection(data.sections.findIndex((s) => s.sweep === throws.sweep[i]));
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
fillSweep();
listen();
if (!openHash() && count) {
  // The first that was dodged, else the first that flew.
  const order = indices();
  const first = order.find((i) => fateOf(i) === 'dodged' && throws.track_size[i]) ??
      order.find((i) => throws.track_size[i]) ?? order[0] ?? 0;
  open(first, false);
}
document.documentElement.dataset.ready = 'true';
