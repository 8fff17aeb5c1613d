// Rates of success: the heat map, the cells of the grid, the curves over speed and sweep.
'use strict';

const kUnits = {m: 'm', mps: 'm/s', deg: 'deg', us: 'us', s: 's', hz: 'Hz', px: 'px'};

// "throw.size_m" is shown as "size", with the unit m beside its values.
function shown(key) {
  const [, name, unit] = /^(?:throw\.)?(.+?)(?:_(m|mps|deg|us|s|hz|px))?$/.exec(key);
  return {name: name.includes('.') ? name : name.replaceAll('_', ' '), unit: kUnits[unit] || ''};
}

function valueText(key, value) {
  const {name, unit} = shown(key);
  return `${name} ${value} ${unit}`.trim();
}

function fillHeat() {
  const pilots = section().pilots;
  byId('pilots').replaceChildren(...pilots.map((pilot, k) => {
    const button = make('button', {type: 'button', textContent: pilotName(pilot)});
    button.setAttribute('aria-pressed', k === state.pilot);
    button.addEventListener('click', () => {
      state.pilot = k;
      fillHeat();
      byId('pilots').children[k].focus();
    });
    return button;
  }));
  const [rows, columns] = data.heat;
  byId('heat-title').textContent = `Dodged, by ${shown(rows.key).name} and ${
      shown(columns.key).name}`;
  const rates = pilots[state.pilot].heat;
  byId('heat').replaceChildren(!rates.length ? empty('Nobody threw.') : heatMap({
    rows: rows.values, columns: columns.values, rates,
    rowUnit: shown(rows.key).unit, columnUnit: shown(columns.key).unit,
    press: (i, j) => chooseCell(
        `${valueText(rows.key, rows.values[i])}, ${valueText(columns.key, columns.values[j])}`,
        (k) => throws.heat_row[k] === i && throws.heat_column[k] === j),
  }));
}

// A line for each of `rows`: [{values, rates, label, press}]. The rate of a pilot that did not fly
// is undefined, and its cell empty. `names`: of the rates.
function rateTable(keys, names, rows) {
  const head = [...keys, ...names];
  const texts = (row) => [...row.values, ...row.rates.map((rate) => (rate ? rateText(rate) : ''))];
  const cells = (row) => texts(row).map((text) => make('td', {textContent: text}));
  return make('table', {},
      make('thead', {}, make('tr', {}, ...head.map((text) => make('th', {textContent: text,
                                                                         scope: 'col'})))),
      make('tbody', {}, ...rows.map((row) => pressable(make('tr', {}, ...cells(row)), row.label,
                                                       row.press))));
}

const cellText = (values) => values.map((v, k) => valueText(data.cells.keys[k], v)).join(', ');

// The rows of a part of the sweep: one for each cell of the grid, and one for all of them together.
function cellRows(part) {
  const {keys, values} = data.cells;
  const choosePart = () => chooseSection(data.sections.indexOf(part));
  const together = {values: keys.map(() => 'all'), label: keys.length ? 'all' : '',
                    rate: (pilot) => pilot.total, press: choosePart};
  if (!keys.length) return [together];
  const rows = values.map((cell, j) => ({
    values: cell, label: cellText(cell), rate: (pilot) => pilot.by_cell[j],
    press: () => {
      if (part !== section()) choosePart();
      chooseCell(cellText(cell), (i) => throws.cell[i] === j);
    }}));
  return rows.length > 1 ? [...rows, together] : rows;
}

function fillCells() {
  if (!data.cells.keys.length) return;
  byId('cells-section').hidden = false;
  const pilots = section().pilots;
  byId('cells').replaceChildren(rateTable(data.cells.keys, pilots.map(rateName),
      cellRows(section()).map((row) => ({...row, rates: pilots.map(row.rate)}))));
}

function fillSpeed() {
  const pilots = section().pilots.filter((p) => p.role !== 'none');
  const {values, middles} = data.speed;
  const bin = values.find((value) => value.includes(' to '));
  byId('speed').replaceChildren(
      !values.length ? empty('Nobody threw.') :
      !middles.length ? empty('The speeds of the grid are no numbers; see the table of its cells.') :
      rateCurves({
        series: pilots.map((p) => ({name: p.name,
                                    points: p.by_speed.map((rate, k) => [middles[k], rate])})),
        xLabel: bin ? `speed [m/s]; a point stands for a bin, such as ${bin}` : 'speed [m/s]',
        label: 'Rate of dodged throws over speed'}));
}

// What the curves of a sweep tell apart: its other keys, else the cells of the grid, else the
// speeds. [{name, sections, rate: (pilot) => rate}]
function sweepLines(x) {
  const all = data.sections;
  if (data.sweep_keys.length > 1) {
    const others = (s) => s.values.map((v, k) => (k === x ? '' : valueText(data.sweep_keys[k], v)))
        .filter(Boolean).join(', ');
    return [...new Set(all.map(others))].map((name) => ({
      name, sections: all.filter((s) => others(s) === name), rate: (p) => p.total}));
  }
  if (data.cells.values.length > 1) {
    return data.cells.values.map((values, j) => ({
      name: cellText(values), sections: all, rate: (p) => p.by_cell[j]}));
  }
  const speeds = data.speed.values.length > 5 ? [] : data.speed.values;
  return speeds.map((speed, j) => ({name: `${speed} m/s`, sections: all, rate: (p) => p.by_speed[j]}));
}

// A chart for each pilot, with its lines; or one for all of them, where there is but one line each.
function sweepCharts(x) {
  const key = data.sweep_keys[x];
  const chart = (series) => rateCurves({series, xLabel: key, label: `Rate of dodged throws over ${key}`});
  const pilots = [{name: flownName(), of: (s) => pilotOf(s, 'flown')},
                  {name: 'oracle', of: (s) => pilotOf(s, 'oracle')}]
      .filter((pilot) => data.sections.some(pilot.of));
  const points = (pilot, sections, rate) => sections.filter(pilot.of)
      .map((s) => [Number(s.values[x]), rate(pilot.of(s))]);
  const lines = sweepLines(x);
  const together = () => chart(pilots.map((p) => (
      {name: p.name, points: points(p, data.sections, (of) => of.total)})));
  if (lines.length < 2) return [together()];
  if (lines.length > kMostLines) {
    const note = empty(`${lines.length} curves would be too many to read; the table has them all.`);
    return data.sweep_keys.length > 1 ? [note] : [together(), note];
  }
  return pilots.map((p) => make('figure', {}, make('figcaption', {textContent: p.name}), chart(
      lines.map((line) => ({name: line.name, points: points(p, line.sections, line.rate)})))));
}
const kMostLines = 8;

// Who flew; a key may sweep the pilots.
function flownName() {
  const names = new Set(data.sections.map((s) => pilotOf(s, 'flown').name));
  return names.size > 1 ? 'the pilot of the sweep' : [...names][0];
}

function fillSweep() {
  if (data.sections.length < 2) return;
  byId('sweep-section').hidden = false;
  const x = data.sweep_keys.findIndex((_, k) =>
      data.sections.every((s) => Number.isFinite(Number(s.values[k]))));
  byId('sweep-curve').replaceChildren(...(x < 0 ? [empty('No key of the sweep is a number: no curve.')] :
                                                  sweepCharts(x)));
  const roles = ['flown', 'oracle', 'none']
      .filter((role) => data.sections.some((s) => pilotOf(s, role)));
  const rows = data.sections.flatMap((part) => {
    const pilots = roles.map((role) => pilotOf(part, role));
    return cellRows(part).map((row) => ({
      ...row, label: [part.label, row.label].filter(Boolean).join(', '),
      values: [...part.values, ...row.values],
      rates: pilots.map((pilot) => pilot && row.rate(pilot))}));
  });
  byId('sweep-table').replaceChildren(
      rateTable([...data.sweep_keys, ...data.cells.keys],
                roles.map((role) => rateName({role, name: role === 'flown' ? flownName() : role})),
                rows));
}
