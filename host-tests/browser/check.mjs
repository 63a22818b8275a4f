// Opens pages in a real browser and says what is wrong with them.
//
//   node check.mjs CHROMIUM PICTURES PAGE.html...
//
// Each page at three widths, light and dark: no error, no request, nothing wider than the window, every chart drawn, its
// switches and its time axis work by pointer and by keyboard, nothing that axe finds wrong, all of it on paper too. Of
// each a picture of the first screen and one of the whole go into the folder PICTURES. Ends with 1 where anything is wrong.
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const WIDTHS = [400, 800, 1400];
const QUIET = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];

const [program, pictures, ...pages] = process.argv.slice(2);
const executablePath = execFileSync("which", [program], { encoding: "utf8" }).trim();
mkdirSync(pictures, { recursive: true });
const browser = await chromium.launch({ executablePath, args: QUIET });
let wrong = 0;
for (const path of pages) {
  const name = `${basename(dirname(path))}-${basename(path, ".html")}`;
  for (const colorScheme of ["light", "dark"]) {
    for (const width of WIDTHS) {
      const found = await look(path, { colorScheme, width, picture: join(pictures, `${name}-${colorScheme}-${width}.png`) });
      for (const fault of found) console.log(`${name}, ${colorScheme}, ${width} px: ${fault}`);
      wrong += found.length;
    }
  }
  console.log(`${name}: seen at ${WIDTHS.join(", ")} px, light and dark`);
}
await browser.close();
console.log(wrong === 0 ? "nothing is wrong" : `${wrong} faults`);
process.exit(wrong === 0 ? 0 : 1);

async function look(path, { colorScheme, width, picture }) {
  const faults = [];
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme });
  const page = await context.newPage();
  page.on("console", (said) => said.type() === "error" && faults.push(`console: ${said.text()}`));
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("request", (request) => request.url().startsWith("file:") || faults.push(`request: ${request.url()}`));
  await page.goto(pathToFileURL(path).href);
  await page.waitForTimeout(200);
  await page.screenshot({ path: picture.replace(/\.png$/, "-first.png") });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  if (wide > 0) faults.push(`${wide} px wider than the window`);
  for (const details of await page.locator("details > summary").all()) await details.click();
  await page.waitForTimeout(200);
  await page.screenshot({ path: picture, fullPage: true });
  faults.push(...(await page.evaluate(charts)));
  faults.push(...(await page.evaluate(overlaps)));
  faults.push(...(await switches(page)), ...(await zoom(page)));
  await page.addScriptTag({ path: AXE });
  for (const { id, help, nodes } of (await page.evaluate(() => axe.run())).violations)
    faults.push(`${id}: ${help}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 120)).join(" | ")}`);
  await page.emulateMedia({ media: "print" });
  const paper = await page.evaluate(() =>
    [...document.querySelectorAll("figure.chart")].filter((f) => f.querySelector("svg").getBoundingClientRect().height < 50).length);
  if (paper > 0) faults.push(`${paper} charts are not on paper`);
  await context.close();
  return faults;
}

// every chart with numbers has ink on its canvas
function charts() {
  const faults = [];
  for (const figure of document.querySelectorAll("figure.chart")) {
    const title = figure.querySelector("figcaption").textContent;
    const { t } = JSON.parse(figure.querySelector("script").textContent);
    const canvas = figure.querySelector("canvas");
    if (t.length < 2) continue;
    if (!canvas || canvas.width === 0) {
      faults.push(`chart ${title} is not drawn`);
      continue;
    }
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    let ink = 0;
    for (let k = 3; k < pixels.length; k += 4) ink += pixels[k] > 0;
    if (ink < 500) faults.push(`chart ${title} is empty: ${ink} pixels`);
  }
  return faults;
}

// no text of a drawing lies on another
function overlaps() {
  const faults = [];
  for (const drawing of document.querySelectorAll("svg")) {
    const boxes = [...drawing.querySelectorAll("text")].map((text) => [text.textContent, text.getBoundingClientRect()]);
    for (const [k, [a, p]] of boxes.entries())
      for (const [b, q] of boxes.slice(k + 1)) {
        const across = Math.min(p.right, q.right) - Math.max(p.left, q.left);
        const down = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
        if (across > 2 && down > 4) faults.push(`“${a}” lies on “${b}” in ${drawing.getAttribute("aria-label")}`);
      }
  }
  return faults;
}

// a switch takes its line off every chart of its group, and brings it back
async function switches(page) {
  const faults = [];
  for (const key of await page.locator("button.key").all()) {
    await key.focus();
    const pressed = async () => (await key.getAttribute("aria-pressed")) === "true";
    const before = await page.evaluate(drawn);
    await page.keyboard.press("Enter");
    await page.waitForTimeout(50);
    if (await pressed()) faults.push(`switch ${await key.textContent()} does not switch off`);
    if ((await page.evaluate(drawn)) === before) faults.push(`switch ${await key.textContent()} changes no chart`);
    await page.keyboard.press("Enter");
    await page.waitForTimeout(50);
    if ((await page.evaluate(drawn)) !== before) faults.push(`switch ${await key.textContent()} does not bring its line back`);
  }
  return faults;
}

// dragging over one chart of a group, and the group's buttons, change the stretch of all; “all” brings the whole back
async function zoom(page) {
  const faults = [];
  for (const group of await page.locator(".time").all()) {
    const around = group.locator("xpath=ancestor::*[.//*[contains(@class, 'u-over')]][1]");
    if ((await around.count()) === 0) continue;
    const title = await around.locator("figcaption").first().textContent();
    faults.push(...(await zoomed(page, group, around)).map((fault) => `${fault}: ${title}`));
  }
  return faults;
}

async function zoomed(page, group, around) {
  const faults = [];
  const over = around.locator(".u-over").first();
  const before = await page.evaluate(drawn);
  const changes = async (act, fault) => {
    await act();
    await page.mouse.move(0, 0);
    await page.waitForTimeout(50);
    if ((await page.evaluate(drawn)) === before) faults.push(fault);
    await group.getByRole("button", { name: "the whole stretch" }).click();
    await page.mouse.move(0, 0);
    await page.waitForTimeout(50);
    if ((await page.evaluate(drawn)) !== before) faults.push("“all” does not bring the whole stretch back");
  };
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  const y = box.y + box.height / 2;
  await changes(async () => {
    await page.mouse.move(box.x + 0.3 * box.width, y);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.6 * box.width, y, { steps: 4 });
    await page.mouse.up();
    await page.waitForTimeout(50);
    if ((await around.locator(".read").first().textContent()) === "") faults.push("nothing is read under the pointer");
  }, "dragging does not zoom");
  await changes(() => group.getByRole("button", { name: "closer" }).click(), "“closer” does not zoom");
  return faults;
}

// what all charts look like
function drawn() {
  return [...document.querySelectorAll("figure.chart canvas")].map((canvas) => canvas.toDataURL()).join();
}
