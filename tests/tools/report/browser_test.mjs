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

/** Waits until the viewer has drawn again after `action`, then looks at it. */
async function viewerAfter(page, action) {
  const drawn = () => page.evaluate(() => Number(document.getElementById("viewer").dataset.drawn));
  const before = await drawn();
  await action();
  await page.waitForFunction((count) => Number(document.getElementById("viewer").dataset.drawn) > count, before);
  await page.waitForTimeout(120);
  return look(page, "#viewer");
}

async function viewer(page) {
  await page.locator("#viewer").scrollIntoViewIfNeeded();
  await page.waitForTimeout(300);
  let last = await look(page, "#viewer");
  check("the viewer draws: much of it differs from the background", last.kinds > 200 && last.background < 0.98, JSON.stringify({ ...last, bytes: 0 }));
  const changes = async (sentence, action) => {
    const now = await viewerAfter(page, action);
    check(sentence, now.bytes !== last.bytes, "the picture stays the same");
    last = now;
  };
  const press = (text) => () => page.locator("#map .controls").getByRole("button", { name: text, exact: true }).click();
  const flip = (text) => () => page.locator("#map").getByLabel(text, { exact: true }).click();
  await changes("colours by class", press("Class"));
  check("classes have a legend", await page.locator("#viewer .legend .key").count() > 1);
  await changes("colours by height", press("Height"));
  check("height has a scale in metres", /m$/.test((await page.locator("#viewer .ends").textContent()).trim()));
  await changes("the octree as boxes", press("Octree"));
  check("the boxes are counted", /leaves|boxes/.test(await page.locator("#map .lead").textContent()));
  await changes("the dense cloud", press("Cloud of fuse"));
  check("a cloud says how many points it shows", /points of fuse/.test(await page.locator("#map .lead").textContent()));
  await changes("from above", press("Top"));
  await changes("the grid map goes", flip("Grid map"));
  await changes("the trajectory goes", flip("Trajectory"));
  await changes("the cameras go", flip("Cameras"));
  await changes("the truth comes", flip("Truth"));
  await changes("the view of the camera", press("Camera"));
  await changes("from the side", press("Side"));
  await changes("points grow", () => page.getByLabel("Size of points").fill("3"));
  await changes("the height is cut", () => page.getByLabel("Cut off above").fill("0.6"));
  await page.locator("#viewer").focus();
  for (const key of ["ArrowLeft", "ArrowUp", "+", "w", "t"]) await changes(`the key ${key} moves the view`, () => page.keyboard.press(key));
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
    const was = await look(page, canvas);
    await page.locator("#frames").getByLabel(layer, { exact: true }).click();
    await page.waitForTimeout(250);
    check(`the layer "${layer}" is switched`, (await look(page, canvas)).bytes !== was.bytes);
  }
  const here = await at();
  await page.getByLabel("Play").click();
  await page.waitForFunction((frame) => document.querySelector("#frames canvas").dataset.frame !== frame, here);
  await page.getByLabel("Play").click();
  check("play goes through the frames", true);
  const cursor = await page.locator("#trajectory .cursor").first().getAttribute("x1");
  await slider.fill("0");
  await page.waitForTimeout(100);
  check("the charts follow the frame", (await page.locator("#trajectory .cursor").first().getAttribute("x1")) !== cursor);
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
  await sweep.page.waitForFunction(() => Number(document.getElementById("viewer")?.dataset.drawn) > 0);
  check("another instance is shown", (await sweep.page.locator("#pipeline .note").last().textContent()).includes(name), name);
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
