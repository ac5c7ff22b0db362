// -- time -----------------------------------------------------------------------------------------------------------------

function go(to) {
  time = Math.min(Math.max(to, motion.t[0] || 0), motion.t[motion.t.length - 1] || 0);
  wanted = true;
}

function play(on) {
  if (on && time >= motion.end - 1e-9) go(0);
  playing = on;
  $("play").classList.toggle("playing", on);
  $("play").setAttribute("aria-label", on ? "Pause" : "Play");
}

function tick(now) {
  const passed = Math.min((now - last) / 1000, 0.1);
  last = now;
  if (hand && !playing) letGo();
  if (catching !== null) catchUp(30);
  else if (hand) computePulled(8, passed);
  else if (!motion.whole) compute(8);
  else if (ranges) workOutRanges(6);
  if (playing && catching === null) {
    const end = motion.t[motion.t.length - 1] || 0;
    let to = time + passed * speed;
    if (to > end) {
      if (!motion.whole) to = end; // wait until it is worked out
      else if ($("loop").checked) to = motion.t[0];
      else {
        to = end;
        play(false);
      }
    }
    go(to);
  }
  if (wanted) render();
  requestAnimationFrame(tick);
}

function traces() {
  const chosen = $("trace").value, list = chosen === "all" ? data.points : data.points.filter((p) => (chosen === "free" ? p[3] : p[0] === chosen));
  view.forget();
  traced = list.map(([name, body, at], i) => [name, motion.rows.map((q) => view.where(q, body, at)), COLOURS[i % COLOURS.length]]);
  wanted = true;
}

function choose() {
  group = motion.groups[$("group").value] || null;
  $("plots").hidden = !group && motion.whole;
  $("plots").classList.toggle("waiting", !group);
  if (group) {
    if (single >= group.columns.length) single = null;
    plot.lines(group, over(), single);
  }
  wanted = true;
}

// What curves are drawn over: time, or a column of the motion by its name.
function over() {
  const name = $("over").value, part = name && motion.groups.find((g) => g.names.includes(name));
  if (!part) return { t: motion.t, along: motion.t, label: "t [s]", ends: [motion.t[0], motion.end] };
  const along = part.columns[part.names.indexOf(name)], sound = Array.from(along).filter(Number.isFinite);
  return { t: motion.t, along, label: `${name}${part.unit ? ` [${part.unit}]` : ""}`, ends: [Math.min(...sound), Math.max(...sound)] };
}

// Options of a list below headings; the one that was chosen before stays chosen.
function fill(select, options) {
  const before = select.value;
  select.textContent = "";
  for (const [section, text, value] of options) {
    let box = select;
    if (section) {
      box = [...select.children].find((each) => each.label === section) || element("optgroup");
      if (!box.label) select.append(Object.assign(box, { label: section }));
    }
    box.append(new Option(text, value));
  }
  if (options.some((option) => option[2] === before)) select.value = before;
}

const titled = (g) => `${g.title}${g.unit ? ` [${g.unit}]` : ""}`;

// A motion that is not whole yet has no groups: those of the one before keep their places.
function show(next) {
  motion = next;
  if (motion.whole) {
    const select = $("group"), before = select.selectedOptions[0]?.textContent;
    fill(select, motion.groups.map((g, i) => [g.section, titled(g), String(i)]));
    const same = motion.groups.findIndex((g) => titled(g) === before);
    if (same >= 0) select.value = same;
    const columns = motion.groups.filter((g) => !g.log).flatMap((g) => g.names.map((name) => [titled(g), name, name]));
    fill($("over"), [["", "t", ""], ...columns]);
  }
  go(time);
  choose();
  traces();
}
