// -- what the mechanism has inside: freedoms, modes in force, a joint's equations, a motor's torque ------------------------

let jointNames = [], bounded = {}, freedoms = {}, asked = "";
const inside = element("section"), freedomLine = element("p"), modeLine = element("p"), jointBox = element("details"), jointTitle = element("summary"), jointText = element("div"), torque = element("button", "Plot over its coordinate");
inside.id = "inside";
inside.setAttribute("aria-label", "Inside");
freedomLine.id = "freedoms";
modeLine.id = "inForce";
jointBox.id = "joint";
jointBox.hidden = true;
jointText.className = "equations";
jointText.tabIndex = 0;
torque.id = "torque";
torque.hidden = true;
jointBox.append(jointTitle, jointText);
inside.append(freedomLine, modeLine, torque, jointBox);
$("stage").append(inside);

function insideOf(answer) {
  jointNames = answer.joints || [];
  bounded = answer.bounded;
  freedoms = answer.freedoms;
  const redundant = freedoms.redundant || [];
  const parts = freedoms.count === undefined ? [] : [`${freedoms.count} degree${freedoms.count === 1 ? "" : "s"} of freedom`];
  if (redundant.length) parts.push(`redundant: ${redundant.join(", ")}`);
  freedomLine.textContent = parts.join("; ");
  asked = "";
  askJoint();
}

// Rows with bounds and their modes at the time that is shown; those that only push have words of their own.
const SLIDING = ["slides backwards", "at rest", "slides forwards"];
drawn.push(() => {
  const modes = [];
  for (const g of motion.groups || []) g.names.forEach((name, k) => {
    if (!name.endsWith(".mode")) return;
    const row = name.slice(0, -5), mode = Math.round(columnAt(g.columns[k], motion.t, time));
    modes.push(`${row} ${bounded[row] ? bounded[row][mode] : SLIDING[mode + 1]}`);
  });
  modeLine.textContent = modes.join("; ");
});

// The joint that the cursor is in: its equations, asked for where they are shown, and the torque of a motor.
const jointAtCursor = () => {
  const [section, name] = atCursor().split(".");
  return section === "joints" && jointNames.includes(name) ? name : "";
};

async function askJoint() {
  const name = jointAtCursor(), effort = motion.groups.find((g) => g.names.includes(`${name}.effort`));
  jointBox.hidden = !name;
  torque.hidden = !name || !effort;
  if (!torque.hidden) torque.textContent = `Plot ${name}.effort over its coordinate`;
  if (!name) return;
  if (asked === name) return;
  jointTitle.textContent = `Equations of ${name}`;
  if (!jointBox.open) return;
  asked = name;
  const answer = await post("joint", { text: checkedText, name });
  if (asked !== name) return;
  jointTitle.textContent = answer.error ? `Equations of ${name}` : answer.title;
  if (answer.error) jointText.textContent = answer.error;
  else jointText.innerHTML = answer.markup; // formulas; names in them are escaped, and no script or style runs by the page's policy
}
jointBox.addEventListener("toggle", askJoint);
selections.push(() => document.activeElement === T && checkedText === T.value && askJoint());

torque.addEventListener("click", () => {
  const name = jointAtCursor(), at = motion.groups.findIndex((g) => g.names.includes(`${name}.effort`));
  if (at < 0) return;
  $("group").value = String(at);
  askedPlot = titled(motion.groups[at]);
  single = motion.groups[at].names.length > 1 ? motion.groups[at].names.indexOf(`${name}.effort`) : null;
  $("over").value = [`${name}.angle`, `${name}.displacement`].find((x) => [...$("over").options].some((o) => o.value === x)) || "";
  choose();
  $("plot").scrollIntoView({ block: "nearest" });
});

// -- what commands make -----------------------------------------------------------------------------------------------------

for (const button of document.querySelectorAll("[data-make]")) button.addEventListener("click", () => make(button));

async function make(button) {
  const kind = button.dataset.make;
  button.disabled = true;
  say(`making the ${button.textContent.toLowerCase()} ...`);
  const answer = await post("make", { text: T.value, kind });
  button.disabled = false;
  if (answer.error) return say(answer.error, true);
  const link = element("a");
  link.href = URL.createObjectURL(new Blob([decoded(answer.content)], { type: answer.type }));
  link.download = answer.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  say(`made ${answer.name}`);
}
