// A browser for tests: the one of the system, set to draw WebGL without a graphics card.

import { existsSync } from "node:fs";
import { chromium } from "playwright-core";
import { PATIENCE_MS } from "./waiting.mjs";

export const executablePath = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => path && existsSync(path));

const common = ["--no-sandbox", "--force-color-profile=srgb"];

export function launch({ webgl = true } = {}) {
  const graphics = webgl ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"] : ["--disable-gpu", "--disable-3d-apis"];
  return chromium.launch({ executablePath, args: [...common, ...graphics], timeout: PATIENCE_MS });
}
