// The chosen throw: its story, its moments, its flight in 3-D.
'use strict';

const view = new View3d(byId('view'));
let clock = null;  // of the animation
const tracks = byId('tracks').textContent;

// The bytes of one throw, cut from the base64 text of all.
function trackOf(i) {
  const [at, size] = [throws.track_at[i], throws.track_size[i]];
  const first = Math.floor(at / 3);
  const text = tracks.slice(4 * first, 4 * Math.ceil((at + size) / 3));
  return bytesOf(text).subarray(at - 3 * first, at - 3 * first + size);
}

function storyOf(i) {
  const error = data.errors[throws.number[i]];
  if (has(i, 'failed')) return error || 'The simulation failed.';
  if (!has(i, 'thrown')) return fateOf(i);
  const several = throws.objects[i] > 1 ? `${throws.objects[i]} objects, the first a ` : '';
  const parts = [`${several}${data.objects[throws.object[i]]} of ${number(throws.size[i])} m from ` +
                 `${number(throws.distance[i], 1)} m at ${number(throws.speed[i], 1)} m/s: ` +
                 fateOf(i)];
  if (throws.cause[i] !== kNone) parts.push(`, ${data.causes[throws.cause[i]]}`);
  if (Number.isFinite(throws.left[i])) {
    const left = throws.left[i];
    parts.push(`. The evasive command arrived ${number(Math.abs(left), 3)} s ` +
               `${left < 0 ? 'after' : 'before'} the contact of a vehicle that stays; ` +
               (Number.isFinite(throws.needed[i]) ?
                    `the fastest evasion needs ${number(throws.needed[i], 3)} s` :
                    'no manoeuvre would have avoided it within 1 s'));
  }
  return parts.join('') + '.' + (error ? ` ${error}` : '');
}

function open(i, scroll) {
  state.chosen = i;
  stop();
  byId('throw-title').textContent = `Throw ${throws.number[i]}`;
  byId('throw-story').textContent = storyOf(i);
  // Of a flight that failed there is no film.
  const film = has(i, 'failed') ? '--mcap' : '--video', type = has(i, 'failed') ? 'mcap' : 'mp4';
  byId('replay').textContent =
      `${data.replay}${throws.number[i]} ${film} throw${throws.number[i]}.${type}`;
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
