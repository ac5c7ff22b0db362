"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const show = (id) => {
    const found = document.getElementById(id);
    if (!found) return false;
    for (let at = found; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    document.querySelectorAll(".marked").forEach((e) => e.classList.remove("marked"));
    found.classList.add("marked");
    found.scrollIntoView({ block: "center" });
    return true;
  };
  const go = (id) => {
    if (show(id)) history.replaceState(null, "", "#" + encodeURIComponent(id));
  };
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#'], a");
    const href = link && (link.getAttribute("href") || "");
    if (href && href.startsWith("#")) {
      event.preventDefault();
      go(decodeURIComponent(href.slice(1)));
      return;
    }
    const joint = event.target.closest(".scene g.joint");
    if (joint) go("rows-" + joint.dataset.name);
  });
  document.querySelectorAll(".scene g.joint").forEach((joint) => {
    if (!document.getElementById("rows-" + joint.dataset.name)) return;
    joint.setAttribute("tabindex", "0");
    joint.addEventListener("keydown", (event) => { if (event.key === "Enter") go("rows-" + joint.dataset.name); });
  });
  if (location.hash) show(decodeURIComponent(location.hash.slice(1)));
  window.symgen = { ...data, rates };
})();
