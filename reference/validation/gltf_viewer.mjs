// Renders a glTF file in Babylon.js, seen along -y in parallel rays and lit by six suns that stand for light from a
// whole hemisphere:
//   node gltf_viewer.mjs FOLDER FILE.glb OUT.png CHROMIUM WIDTH HEIGHT HEIGHT_M SIDE
// FOLDER holds node_modules with puppeteer-core, @babylonjs/core and @babylonjs/loaders; SIDE is 1 for suns on the side
// of the camera and -1 for suns behind. White that faces the suns comes out at EXPOSURE.
import fs from "fs";
import http from "http";
import { createRequire } from "module";
import path from "path";

const [, , folder, file, out, chromium, width, height, metres, side] = process.argv;
const EXPOSURE = 0.9;
const page = `<body style="margin:0"><canvas id=c width=${width} height=${height}></canvas>
<script type=importmap>{"imports": {
  "@babylonjs/core": "/node_modules/@babylonjs/core/index.js",
  "@babylonjs/core/": "/node_modules/@babylonjs/core/",
  "@babylonjs/loaders/": "/node_modules/@babylonjs/loaders/"}}</script>
<script type=module>
import * as B from "@babylonjs/core";
import "@babylonjs/loaders/glTF/index.js";
const engine = new B.Engine(document.getElementById("c"), false, { preserveDrawingBuffer: true });
engine.loadingScreen = { displayLoadingUI() {}, hideLoadingUI() {} };
const scene = new B.Scene(engine);
scene.useRightHandedSystem = true;
scene.clearColor = new B.Color4(0, 0, 0, 1);
scene.imageProcessingConfiguration.toneMappingEnabled = false;
try {
  await B.AppendSceneAsync("/file.glb", scene);
  const camera = new B.FreeCamera("camera", new B.Vector3(0, 0.3, 0), scene);
  camera.mode = B.Camera.ORTHOGRAPHIC_CAMERA;
  camera.upVector = new B.Vector3(0, 0, -1);
  camera.setTarget(B.Vector3.Zero());
  camera.minZ = 0.01;
  [camera.orthoTop, camera.orthoBottom] = [${metres} / 2, -${metres} / 2];
  [camera.orthoRight, camera.orthoLeft] = [1, -1].map(s => s * ${metres} / 2 * ${width} / ${height});
  for (const [number, part] of [1 / 6, 3 / 6, 5 / 6].entries()) {
    const polar = Math.asin(Math.sqrt(part));
    for (const azimuth of [0.5 + number, 0.5 + number + Math.PI]) {
      const x = Math.sin(polar) * Math.cos(azimuth), y = Math.sin(polar) * Math.sin(azimuth);
      const towards = new B.Vector3(x, ${side} * Math.cos(polar), -y);
      const sun = new B.DirectionalLight("sun", towards.scale(-1), scene);
      sun.intensity = ${EXPOSURE} * Math.PI / 6 / Math.cos(polar);
    }
  }
  for (const material of scene.materials) material.maxSimultaneousLights = 6;
  await scene.whenReadyAsync();
  scene.render();
  scene.render();
  window.done = "yes";
} catch (error) { window.done = String(error); }
</script>`;
const server = http.createServer((request, response) => {
  const name = request.url.split("?")[0];
  const found = name === "/file.glb" ? file : path.join(folder, name);
  response.setHeader("content-type", name.endsWith(".js") ? "text/javascript" : "text/html");
  if (name === "/") return response.end(page);
  if (!fs.existsSync(found)) response.statusCode = 404;
  response.end(response.statusCode === 404 ? "" : fs.readFileSync(found));
});
await new Promise(ready => server.listen(0, "127.0.0.1", ready));
const require = createRequire(path.join(folder, "here.js"));
const { default: puppeteer } = await import(require.resolve("puppeteer-core"));
const args = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await puppeteer.launch({ executablePath: chromium, args });
const tab = await browser.newPage();
await tab.setViewport({ width: Number(width), height: Number(height) });
await tab.goto(`http://127.0.0.1:${server.address().port}/`);
await tab.waitForFunction("window.done", { timeout: 300000 });
const done = await tab.evaluate("window.done");
await tab.screenshot({ path: out });
await browser.close();
server.close();
if (done !== "yes") throw new Error(done);
