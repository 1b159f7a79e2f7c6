// The page: one set of sections for the instance that is chosen.
import { el } from "./dom.js";
import { facts, frame } from "./facts.js";
import { overview } from "./overview.js";
import { sweep } from "./sweep.js";
import { map } from "./map.js";
import { trajectory } from "./trajectory.js";
import { frames } from "./frames.js";
import { interactions } from "./interactions.js";
import { sizes } from "./sizes.js";
import { pipeline } from "./pipeline.js";

const kSections = [
  ["map", "Map", map], ["trajectory", "Trajectory", trajectory], ["frames", "Frames", frames],
  ["interactions", "Interactions", interactions], ["sizes", "Sizes", sizes], ["pipeline", "Pipeline", pipeline],
];
const content = document.getElementById("content");
const sections = document.getElementById("sections");
const isSweep = facts.instances.length > 1;

function show(instance) {
  frame.forget();
  const parts = [["overview", "Overview", overview(instance, facts, isSweep && chooser(instance))]];
  if (isSweep) parts.push(["sweep", "Sweep", sweep(facts, instance, (other) => { show(other); scrollTo("map"); })]);
  for (const [id, name, make] of kSections) {
    const made = make(instance);
    if (made) parts.push([id, name, made]);
  }
  content.replaceChildren(...parts.map(([id, name, made]) =>
    el("section", { id, "aria-labelledby": id === "overview" ? null : `${id}-name` },
      id === "overview" ? null : el("h2", { id: `${id}-name` }, name), made)));
  sections.replaceChildren(...parts.map(([id, name]) => el("a", { href: `#${id}` }, name)));
  watch();
  const first = instance.frames?.frames.length ? instance.frames.frames[Math.floor(instance.frames.frames.length / 2)].stamp : null;
  if (first) frame.choose(first);
}

const scrollTo = (id) => document.getElementById(id)?.scrollIntoView();

function chooser(chosen) {
  const list = el("select", { id: "instance", "aria-label": "Instance", onchange: () => show(facts.instances[list.selectedIndex]) },
    facts.instances.map((one) => el("option", { selected: one === chosen }, one.name)));
  return el("div", { class: "controls" }, el("label", {}, "Shown below", list));
}

/** Marks the section in view in the navigation. */
let watcher = null;
function watch() {
  watcher?.disconnect();
  watcher = new IntersectionObserver((entries) => {
    for (const entry of entries)
      if (entry.isIntersecting)
        for (const link of sections.children)
          if (link.hash === `#${entry.target.id}`) link.setAttribute("aria-current", "true");
          else link.removeAttribute("aria-current");
  }, { rootMargin: "-15% 0px -75% 0px" });
  for (const section of content.children) watcher.observe(section);
}

const dark = matchMedia("(prefers-color-scheme: dark)");
let theme = dark.matches ? "dark" : "light";
function useTheme(name) {
  theme = name;
  document.documentElement.dataset.theme = name;
  document.dispatchEvent(new Event("themechange"));
}
dark.addEventListener("change", () => useTheme(dark.matches ? "dark" : "light"));
document.getElementById("theme").addEventListener("click", () => useTheme(theme === "dark" ? "light" : "dark"));

document.title = `${facts.name} \u2013 Sediment`;
useTheme(theme);
show(facts.instances.find((one) => one.stages.length) ?? facts.instances[0]);
