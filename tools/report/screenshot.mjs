// A picture of a page of `sediment report`, from headless Chromium.
// usage: NODE_PATH=third_party/web/node_modules node tools/report/screenshot.mjs PAGE.html PICTURE.jpg
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const [file, picture] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1240, height: 1010 } });
page.setDefaultTimeout(180000);
await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => Number(document.getElementById("viewer")?.dataset.drawn) > 0);
await page.waitForTimeout(500);
await page.screenshot({ path: picture, quality: 80, type: "jpeg" });
await browser.close();
