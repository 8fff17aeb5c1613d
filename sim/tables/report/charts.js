// Charts as SVG elements. Colours come from the style sheet.
'use strict';

function svg(tag, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  for (const child of children) {
    element.append(typeof child === 'object' ? child : document.createTextNode(child));
  }
  return element;
}

// A rate is [count, of, lo, hi], with the name of its interval if that is not Wilson's.
const rateOf = ([count, of]) => (of ? count / of : NaN);
const two = (x) => x.toFixed(2);
const intervalText = ([, , lo, hi, name]) => `${two(lo)} to ${two(hi)}${name ? `, ${name}` : ''}`;
const rateText = (rate) =>
    rate[1] ? `${two(rateOf(rate))} (${rate[0]} of ${rate[1]}, ${intervalText(rate)})`
            : 'no throws';

// Makes an element act as a button.
function pressable(element, label, press) {
  element.setAttribute('role', 'button');
  element.setAttribute('tabindex', '0');
  element.setAttribute('aria-label', label);
  element.addEventListener('click', press);
  element.addEventListener('keydown', (e) => {
    if (e.key !== 'Enter' && e.key !== ' ') return;
    e.preventDefault();
    press();
  });
  return element;
}

// From light to dark blue: ordered without colour vision, too.
function heatColour(share) {
  const ends = [[247, 243, 232], [122, 172, 212], [8, 48, 107]];
  const at = 2 * Math.min(1, Math.max(0, share));
  const [a, b] = at < 1 ? [ends[0], ends[1]] : [ends[1], ends[2]];
  const t = at < 1 ? at : at - 1;
  return `rgb(${a.map((x, i) => Math.round(x + t * (b[i] - x))).join(',')})`;
}

// rows x columns of rates; press(row, column) when a cell is chosen.
function heatMap({rows, columns, rates, rowUnit, columnUnit, press}) {
  const [cellW, cellH, left, top] = [104, 62, 92, 30];
  const width = left + cellW * columns.length;
  const height = top + cellH * rows.length;
  // Smaller, nobody could read it: a narrow screen scrolls.
  const chart = svg('svg', {viewBox: `0 0 ${width} ${height}`, class: 'heat',
                            style: `max-width:${width}px;min-width:${0.75 * width}px`});
  columns.forEach((name, j) => chart.append(svg('text',
      {x: left + cellW * (j + 0.5), y: top - 10, class: 'label', 'text-anchor': 'middle'},
      `${name} ${columnUnit}`)));
  rows.forEach((name, i) => {
    chart.append(svg('text', {x: left - 8, y: top + cellH * (i + 0.5) + 4, class: 'label',
                              'text-anchor': 'end'}, `${name} ${rowUnit}`));
    columns.forEach((column, j) => {
      const rate = rates[i][j];
      const [x, y] = [left + cellW * j, top + cellH * i];
      const share = rateOf(rate);
      const cell = svg('g', {class: 'cell'});
      cell.append(svg('rect', {x: x + 1, y: y + 1, width: cellW - 2, height: cellH - 2, rx: 4,
                               fill: rate[1] ? heatColour(share) : 'none',
                               class: rate[1] ? '' : 'void'}));
      if (rate[1]) {
        const ink = share > 0.55 ? '#fff' : '#111';
        const line = (dy, size, text) => svg('text', {x: x + cellW / 2, y: y + dy, fill: ink,
            'font-size': size, 'text-anchor': 'middle'}, text);
        cell.append(line(23, 17, two(share)), line(39, 11.5, `${two(rate[2])} to ${two(rate[3])}`),
                    line(53, 11.5, `${rate[0]} of ${rate[1]}`));
        pressable(cell, `${name} ${rowUnit}, ${column} ${columnUnit}: ${rateText(rate)}`,
                  () => press(i, j));
      }
      chart.append(cell);
    });
  });
  return chart;
}

const frame = {width: 460, height: 270, left: 46, right: 14, top: 12, bottom: 42};

function ticks(lo, hi, most, leastStep = 0) {
  const raw = Math.max((hi - lo) / most, leastStep);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const values = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + 1e-9 * step; ++i) {
    values.push(Number((i * step).toPrecision(12)));
  }
  return values;
}

// Axes with grid lines. Returns {chart, x, y}: the element and both scales.
function axes({xLabel, yLabel, xLo, xHi, yLo, yHi, label, leastStep = 0}) {
  const {width, height, left, right, top, bottom} = frame;
  const chart = svg('svg', {viewBox: `0 0 ${width} ${height}`, class: 'chart', role: 'img',
                            'aria-label': label});
  const x = (v) => left + ((v - xLo) / (xHi - xLo || 1)) * (width - left - right);
  const y = (v) => height - bottom - ((v - yLo) / (yHi - yLo || 1)) * (height - top - bottom);
  for (const v of ticks(yLo, yHi, 5, leastStep)) {
    chart.append(svg('line', {x1: left, x2: width - right, y1: y(v), y2: y(v), class: 'grid'}),
                 svg('text', {x: left - 6, y: y(v) + 4, class: 'tick', 'text-anchor': 'end'}, v));
  }
  for (const v of ticks(xLo, xHi, 6)) {
    chart.append(svg('line', {x1: x(v), x2: x(v), y1: top, y2: height - bottom, class: 'grid'}),
                 svg('text', {x: x(v), y: height - bottom + 16, class: 'tick',
                              'text-anchor': 'middle'}, v));
  }
  chart.append(svg('text', {x: (left + width - right) / 2, y: height - 6, class: 'label',
                            'text-anchor': 'middle'}, xLabel),
               svg('text', {x: 12, y: (top + height - bottom) / 2, class: 'label',
                            'text-anchor': 'middle',
                            transform: `rotate(-90 12 ${(top + height - bottom) / 2})`}, yLabel));
  return {chart, x, y};
}

const markers = [
  (x, y) => svg('circle', {cx: x, cy: y, r: 4.5}),
  (x, y) => svg('rect', {x: x - 4, y: y - 4, width: 8, height: 8}),
  (x, y) => svg('path', {d: `M${x} ${y - 5.5}l5 9h-10z`}),
  (x, y) => svg('path', {d: `M${x} ${y - 6}l6 6l-6 6l-6-6z`}),
];

// A name that is empty is left out.
function legendOf(names) {
  const legend = document.createElement('div');
  legend.className = 'legend';
  names.forEach((name, k) => {
    if (!name) return;
    const key = svg('svg', {viewBox: '0 0 14 14', class: `series s${k % 6}`});
    key.append(markers[k % markers.length](7, 7));
    const item = document.createElement('span');
    item.append(key, name);
    legend.append(item);
  });
  return legend;
}

// Rates over a number, with the band of their intervals. series: [{name, points: [[x, rate]]}].
// They stand a little apart, so that none hides behind another.
function rateCurves({series, xLabel, label}) {
  const drawn = (s) => s.points.some(([, rate]) => rate[1] > 0);
  if (!series.some(drawn)) return empty('No such throws.');
  const xs = series.flatMap((s) => s.points.map(([x]) => x));
  const [least, most] = [Math.min(...xs), Math.max(...xs)];
  const margin = 0.06 * (most - least) || 0.5;
  const {chart, x: place, y} = axes({xLabel, yLabel: 'dodged', label, xLo: least - margin,
                                     xHi: most + margin, yLo: 0, yHi: 1});
  series.forEach((s, k) => {
    const x = (v) => place(v) + 4 * (k - (series.length - 1) / 2);
    const points = s.points.filter(([, rate]) => rate[1] > 0).sort(([a], [b]) => a - b);
    const group = svg('g', {class: `series s${k % 6}`});
    const forth = points.map(([v, r]) => `${x(v)},${y(r[3])}`);
    const back = points.map(([v, r]) => `${x(v)},${y(r[2])}`).reverse();
    if (points.length > 1) {
      group.append(svg('polygon', {points: [...forth, ...back].join(' '), class: 'band'}),
                   svg('polyline', {points: points.map(([v, r]) => `${x(v)},${y(rateOf(r))}`)
                       .join(' ')}));
    }
    for (const [v, rate] of points) {
      group.append(svg('line', {x1: x(v), x2: x(v), y1: y(rate[2]), y2: y(rate[3])}));
      const marker = markers[k % markers.length](x(v), y(rateOf(rate)));
      marker.append(svg('title', {}, `${s.name}, ${v}: ${rateText(rate)}`));
      group.append(marker);
    }
    chart.append(group);
  });
  const figure = document.createElement('div');
  figure.append(chart, legendOf(series.map((s) => drawn(s) && s.name)));
  return figure;
}

// How often values fall into bins. series: [{name, values}]; values beyond `most` are in the last
// bin.
function histogram({series, xLabel, yLabel = 'throws', most, bins = 24, label}) {
  const finite = series.map((s) => s.values.filter(Number.isFinite));
  const all = finite.flat();
  if (!all.length) return empty('No such throws.');
  let hi = 0;
  for (const v of all) hi = Math.max(hi, v);
  hi = Math.min(hi, most) || 1;
  const counts = finite.map((values) => {
    const count = new Array(bins).fill(0);
    for (const v of values) ++count[Math.max(0, Math.min(bins - 1, Math.floor((v / hi) * bins)))];
    return count;
  });
  const {chart, x, y} = axes({xLabel, yLabel, label, xLo: 0, xHi: hi, yLo: 0,
                              yHi: Math.max(1, ...counts.flat()), leastStep: 1});
  const share = 0.86 / series.length;
  counts.forEach((count, k) => {
    const group = svg('g', {class: `series s${k % 6}`});
    count.forEach((n, i) => {
      if (!n) return;
      const left = x(((i + 0.07 + share * k) / bins) * hi);
      const bar = svg('rect', {x: left, width: x((share / bins) * hi) - x(0), y: y(n),
                               height: y(0) - y(n), class: 'bar'});
      bar.append(svg('title', {}, `${two((i * hi) / bins)} to ${two(((i + 1) * hi) / bins)}: ${n}`));
      group.append(bar);
    });
    chart.append(group);
  });
  const figure = document.createElement('div');
  figure.append(chart);
  if (series.length > 1) figure.append(legendOf(series.map((s) => s.name)));
  return figure;
}

function empty(text) {
  const p = document.createElement('p');
  p.className = 'muted';
  p.textContent = text;
  return p;
}
