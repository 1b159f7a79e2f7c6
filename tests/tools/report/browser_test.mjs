// Opens pages of `sediment report` in headless Chromium and works their controls.
// usage: node browser_test.mjs RUN.html SWEEP.html [FOLDER for pictures]
import { createRequire } from "node:module";
import { mkdirSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

// CommonJS resolution heeds NODE_PATH.
const { chromium } = createRequire(import.meta.url)("playwright-core");
const [runPage, sweepPage, pictures] = process.argv.slice(2);
let failures = 0;

function check(sentence, holds, found = "") {
  console.log(`${holds ? "ok" : "FAILED"}: ${sentence}${holds ? "" : ` (${found})`}`);
  if (!holds) ++failures;
}

/** How many different colours a picture of an element has, and its bytes for comparison. */
async function look(page, selector) {
  const shot = await page.locator(selector).screenshot();
  const colors = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
    const counts = new Map();
    for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
    return { kinds: counts.size, background: [...counts.values()].reduce((most, count) => Math.max(most, count), 0) / pixels.length };
  }, shot.toString("base64"));
  return { ...colors, bytes: shot.toString("base64") };
}

async function open(browser, file, options) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  page.setDefaultTimeout(180000);  // a machine that is busy with other tests
  const errors = [], requests = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => /^https?:/.test(request.url()) && requests.push(request.url()));
  const began = Date.now();
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("#viewer canvas");
  await page.waitForFunction(() => Number(document.getElementById("viewer").dataset.drawn) > 0);
  console.log(`opened ${file} in ${((Date.now() - began) / 1000).toFixed(2)} s`);
  return { page, errors, requests };
}

/** Asks again until `holds` says yes, at most a minute: a busy machine draws late, but it draws. */
async function becomes(page, holds) {
  for (const end = Date.now() + 60000; Date.now() < end; await page.waitForTimeout(50)) if (await holds()) return true;
  return false;
}

/** An element's picture once nothing moves in it any more: two pictures in a row are equal. */
async function settled(page, selector) {
  let now = await look(page, selector);
  await becomes(page, async () => {
    const before = now.bytes;
    await page.waitForTimeout(100);
    now = await look(page, selector);
    return now.bytes === before;
  });
  return now;
}

/** Does `action` on a still picture and checks that it becomes another one. */
async function changes(page, selector, sentence, action) {
  const before = await settled(page, selector);
  await action();
  check(sentence, await becomes(page, async () => (await look(page, selector)).bytes !== before.bytes), "the picture stays the same");
}

async function viewer(page) {
  await page.locator("#viewer").scrollIntoViewIfNeeded();
  const first = await settled(page, "#viewer");
  check("the viewer draws: much of it differs from the background", first.kinds > 200 && first.background < 0.98, JSON.stringify({ ...first, bytes: 0 }));
  const turns = (sentence, action) => changes(page, "#viewer", sentence, action);
  const press = (text) => () => page.locator("#map .controls").getByRole("button", { name: text, exact: true }).click();
  const flip = (text) => () => page.locator("#map").getByLabel(text, { exact: true }).click();
  await turns("colours by class", press("Class"));
  check("classes have a legend", await page.locator("#viewer .legend .key").count() > 1);
  await turns("colours by height", press("Height"));
  check("height has a scale in metres", /m$/.test((await page.locator("#viewer .ends").textContent()).trim()));
  await turns("the octree as boxes", press("Octree"));
  check("the boxes are counted", /leaves|boxes/.test(await page.locator("#map .lead").textContent()));
  await turns("the dense cloud", press("Cloud of fuse"));
  check("a cloud says how many points it shows", /points of fuse/.test(await page.locator("#map .lead").textContent()));
  await turns("from above", press("Top"));
  await turns("the grid map goes", flip("Grid map"));
  await turns("the trajectory goes", flip("Trajectory"));
  await turns("the cameras go", flip("Cameras"));
  await turns("the truth comes", flip("Truth"));
  await turns("the view of the camera", press("Camera"));
  await turns("from the side", press("Side"));
  await turns("points grow", () => page.getByLabel("Size of points").fill("3"));
  await turns("the height is cut", () => page.getByLabel("Cut off above").fill("0.6"));
  await page.locator("#viewer").focus();
  for (const key of ["ArrowLeft", "ArrowUp", "+", "w", "t"]) await turns(`the key ${key} moves the view`, () => page.keyboard.press(key));
}

async function scrubber(page) {
  await page.locator("#frames").scrollIntoViewIfNeeded();
  const canvas = "#frames canvas";
  const at = () => page.locator(canvas).getAttribute("data-frame");
  await page.waitForFunction(() => document.querySelector("#frames canvas").dataset.frame !== undefined);
  const before = await at(), slider = page.getByLabel("Frame", { exact: true });
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction((frame) => document.querySelector("#frames canvas").dataset.frame !== frame, before);
  check("an arrow key goes to the next frame", Number(await at()) > Number(before), await at());
  for (const layer of ["Instances", "What moves", "Features"]) {
    const flip = () => page.locator("#frames").getByLabel(layer, { exact: true }).click();
    await changes(page, canvas, `the layer "${layer}" is switched`, flip);
  }
  const here = await at();
  await page.getByLabel("Play").click();
  await page.waitForFunction((frame) => document.querySelector("#frames canvas").dataset.frame !== frame, here);
  await page.getByLabel("Play").click();
  check("play goes through the frames", true);
  const cursor = () => page.locator("#trajectory .cursor").first().getAttribute("x1");
  const there = await cursor();
  await slider.fill((await slider.inputValue()) === "0" ? "1" : "0");  // play may have come round to the first
  check("the charts follow the frame", await becomes(page, async () => (await cursor()) !== there));
}

async function tables(page) {
  const table = page.locator('[data-table="stages"]');
  const column = async () => (await table.locator("tbody tr td:nth-child(3)").allTextContents()).map(Number);
  await table.getByRole("button", { name: "wall [s]" }).click();
  let seconds = await column();
  check("a click on a heading sorts, the largest first", seconds.every((x, i) => i === 0 || seconds[i - 1] >= x), seconds);
  await table.getByRole("button", { name: "wall [s]" }).click();
  seconds = await column();
  check("a second click turns the order", seconds.every((x, i) => i === 0 || seconds[i - 1] <= x), seconds);
  const [download] = await Promise.all([page.waitForEvent("download"), table.getByRole("button", { name: "CSV" }).click()]);
  const text = readFileSync(await download.path(), "utf8");
  check("a table can be downloaded", text.startsWith("stage,state,wall [s]") && text.trim().split("\n").length === seconds.length + 1, text.slice(0, 80));
}

async function stages(page) {
  const node = page.locator('.dag .node[data-name="voxel"]');
  await node.focus();
  await page.keyboard.press("Enter");
  check("a stage is chosen by keyboard", (await page.locator("#stage-detail h3").first().textContent()) === "voxel");
  check("its parameters are shown", (await page.locator("#stage-detail").textContent()).includes("leaf"));
}

async function theme(page) {
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const before = await paper();
  await page.locator("#theme").click();
  check("light becomes dark", (await paper()) !== before);
  await page.locator("#theme").click();
}

async function sections(page, name) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  for (const id of await page.evaluate(() => [...document.querySelectorAll("main > section")].map((section) => section.id)))
    await page.locator(`#${id}`).screenshot({ path: join(pictures, `${name}_${id}.png`) });
}

const scratch = mkdtempSync(join(tmpdir(), "report-test-"));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", downloadsPath: scratch,
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const run = await open(browser, runPage, { viewport: { width: 1280, height: 900 } });
  await sections(run.page, "run");
  await viewer(run.page);
  await scrubber(run.page);
  await tables(run.page);
  await stages(run.page);
  await theme(run.page);
  check("no error on the console of a run", run.errors.length === 0, run.errors.join("; "));
  check("nothing is asked from a network", run.requests.length === 0, run.requests.join(" "));

  const sweep = await open(browser, sweepPage, { viewport: { width: 1280, height: 900 }, colorScheme: "dark" });
  await sections(sweep.page, "sweep");
  const name = await sweep.page.locator("#instance option").nth(5).textContent();
  await sweep.page.locator("#instance").selectOption({ index: 5 });
  const shown = async () => (await sweep.page.locator("#pipeline .note").last().textContent()).includes(name);
  check("another instance is shown", await becomes(sweep.page, shown), name);
  check("the sweep has a row for each instance", await sweep.page.locator('[data-table="sweep"] tbody tr').count() === 8);
  const plot = await look(sweep.page, "#sweep-plot");
  await sweep.page.getByLabel("Vertical").selectOption({ label: "time [s]" });
  check("the plot shows what is asked for", (await look(sweep.page, "#sweep-plot")).bytes !== plot.bytes);
  await sweep.page.locator('[data-table="sweep"] tbody .link').first().click();
  check("a click on a row shows that instance", await sweep.page.locator("#instance").evaluate((list) => list.selectedIndex) === 0);
  check("no error on the console of a sweep", sweep.errors.length === 0, sweep.errors.join("; "));

  const phone = await open(browser, runPage, { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true });
  await sections(phone.page, "phone");
  const wide = await phone.page.evaluate(() => document.documentElement.scrollWidth);
  check("on a phone nothing is wider than the screen", wide <= 390, wide);
  check("no error on the console of a phone", phone.errors.length === 0, phone.errors.join("; "));
} finally {
  await browser.close();
}
process.exit(failures === 0 ? 0 : 1);
