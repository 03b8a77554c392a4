// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the stage with WebGL 2: matt paper under one lamp that casts a shadow, lines of a given width, ghosts.

/** @typedef {import("./camera.js").Camera} Camera */

/**
 * What is drawn. Triangles come first by their corners: place and normal (six numbers), colour and opacity (four
 * bytes), place on the picture of its page (two numbers). Lines have two ends (six numbers), colour and opacity
 * (four bytes) and a width in pixels.
 * @typedef {object} Picture
 * @property {Camera} camera
 * @property {Float32Array} corners
 * @property {Uint8Array} tints
 * @property {{from: number, to: number, page: number}[]} runs triangles of one page
 * @property {boolean} painted with the pictures of the pages
 * @property {boolean} ghosts whether some triangles are transparent
 * @property {(triangle: number) => boolean} placed whether its piece is in its place in the model
 * @property {Float32Array} lines
 * @property {Uint8Array} lineTints
 * @property {Float32Array} lineWidths
 * @property {number} lineCount
 * @property {number} markCount of the last lines, which are seen through everything
 * @property {{corners: number[][], opacity: number}[]} sheets on the table
 * @property {number[]} paper colour of back sides, 0 to 1
 * @property {number} shade how dark shadows on the table are
 */

const head = "#version 300 es\nprecision highp float;\nprecision highp sampler2DShadow;\n";

const faceVertex = `${head}
layout(location=0) in vec3 place; layout(location=1) in vec3 normal; layout(location=2) in vec4 tint;
layout(location=3) in vec2 spot;
uniform mat4 view; uniform mat4 lamp; uniform float grain;
out vec3 n; out vec4 colour; out vec2 at; out vec4 lit; out vec3 p;
void main() {
  n = normal; colour = tint; at = spot; p = place;
  lit = lamp * vec4(place + grain * normal, 1.0);
  gl_Position = view * vec4(place, 1.0);
}`;

/** How much of the lamp comes through: the map is asked at n times n places, each of which it takes between four of its own. */
const lampLight = (/** @type {number} */ n) => `
uniform sampler2DShadow shadow;
float light(vec4 lit, float spread) {
  vec3 s = 0.5 + 0.5 * lit.xyz;
  if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < ${n}; ++i) for (int j = 0; j < ${n}; ++j)
    sum += texture(shadow, vec3(s.xy + (vec2(i, j) - ${(0.5 * (n - 1)).toFixed(1)}) * spread * ${(4 / n).toFixed(1)} / 1024.0, s.z - 0.0012));
  return sum / ${(n * n).toFixed(1)};
}`;

const faceFragment = (/** @type {number} */ n) => `${head}
in vec3 n; in vec4 colour; in vec2 at; in vec4 lit; in vec3 p;
uniform sampler2D paint; uniform vec3 sun; uniform vec3 eye; uniform vec3 back; uniform int pass;
out vec4 shown;
${lampLight(n)}
void main() {
  if (pass == 0 ? colour.a < 0.99 : colour.a >= 0.99) discard;
  if (pass == 2) {
    shown = colour;
    return;
  }
  vec3 m = normalize(gl_FrontFacing ? n : -n);
  vec3 base = gl_FrontFacing ? colour.rgb * texture(paint, at).rgb : back;
  base = pow(base, vec3(2.2));
  float fall = dot(m, sun);
  float towards = smoothstep(-0.02, 0.12, fall);
  float key = smoothstep(-0.35, 1.0, fall) * mix(0.45, 1.0, towards > 0.0 ? light(lit, 0.9) * towards : 0.0);
  vec3 sky = mix(vec3(0.34, 0.33, 0.33), vec3(0.52, 0.54, 0.57), 0.5 + 0.5 * m.y);
  float facing = max(0.0, dot(m, normalize(eye - p)));
  vec3 sum = base * (sky * (0.75 + 0.25 * facing) + vec3(0.56, 0.55, 0.52) * key);
  shown = vec4(pow(min(sum, 1.0), vec3(1.0 / 2.2)), colour.a);
}`;

const shadowFragment = `${head}
in vec3 n; in vec4 colour; in vec2 at; in vec4 lit; in vec3 p;
void main() { if (colour.a < 0.35) discard; }`;

const groundVertex = `${head}
layout(location=0) in vec3 place;
uniform mat4 view; uniform mat4 lamp;
out vec4 lit; out vec3 p;
void main() { p = place; lit = lamp * vec4(place, 1.0); gl_Position = view * vec4(place, 1.0); }`;

const groundFragment = (/** @type {number} */ n) => `${head}
in vec4 lit; in vec3 p;
uniform vec4 colour; uniform float shade; uniform vec3 middle; uniform float reach;
out vec4 shown;
${lampLight(n)}
void main() {
  float near = 1.0 - smoothstep(0.5, 1.0, distance(p, middle) / reach);
  float dark = near > 0.0 ? shade * (1.0 - light(lit, 3.0)) * near : 0.0;
  shown = vec4(colour.rgb * (1.0 - dark), max(colour.a, dark));
}`;

const lineVertex = `${head}
layout(location=0) in vec3 a; layout(location=1) in vec3 b; layout(location=2) in vec4 tint;
layout(location=3) in float width;
uniform mat4 view; uniform vec2 size; uniform float lift; uniform float ratio;
out vec4 colour; out float across; out float half_width;
void main() {
  vec4 p = view * vec4(a, 1.0);
  vec4 q = view * vec4(b, 1.0);
  vec2 along = (q.xy / q.w - p.xy / p.w) * size;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  float side = float(gl_VertexID & 1) * 2.0 - 1.0;
  half_width = 0.5 * width * ratio;
  across = side * (half_width + 1.0);
  vec4 at = gl_VertexID < 2 ? p : q;
  at.xy += (vec2(-along.y, along.x) * across + along * (gl_VertexID < 2 ? -0.5 : 0.5) * half_width) * 2.0 / size * at.w;
  at.z -= lift * at.w;
  colour = tint;
  gl_Position = at;
}`;

const lineFragment = `${head}
in vec4 colour; in float across; in float half_width;
uniform float opacity;
out vec4 shown;
void main() { shown = vec4(colour.rgb, colour.a * opacity * clamp(half_width + 0.5 - abs(across), 0.0, 1.0)); }`;

const shadowSize = 1024;

/** What draws here, as its driver calls itself. */
function rendererName() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const details = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl ? String(gl.getParameter(details ? details.UNMASKED_RENDERER_WEBGL : gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return name;
}

class WebglView {
  /** @param {HTMLCanvasElement} canvas Throws where there is no WebGL 2. */
  constructor(canvas) {
    // Without a graphics card the processor draws, for whom smooth edges and shadows are most of the work.
    const hasCard = !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(rendererName());
    const gl = canvas.getContext("webgl2", {antialias: hasCard, alpha: true});
    if (!gl) {
      throw new Error("no WebGL 2");
    }
    const taps = hasCard ? 2 : 1;
    this.gl = gl;
    this.canvas = canvas;
    this.faces = this.#program(faceVertex, faceFragment(taps));
    this.shadows = this.#program(faceVertex, shadowFragment);
    this.ground = this.#program(groundVertex, groundFragment(taps));
    this.lines = this.#program(lineVertex, lineFragment);
    this.corners = this.#buffer();
    this.tints = this.#buffer();
    this.spots = this.#buffer();
    this.ends = this.#buffer();
    this.lineTints = this.#buffer();
    this.widths = this.#buffer();
    this.quad = this.#buffer();
    this.faceArray = this.#array([[this.corners, 3, gl.FLOAT, 24, 0], [this.corners, 3, gl.FLOAT, 24, 12],
      [this.tints, 4, gl.UNSIGNED_BYTE, 4, 0], [this.spots, 2, gl.FLOAT, 8, 0]], 0);
    this.lineArray = this.#array([[this.ends, 3, gl.FLOAT, 24, 0], [this.ends, 3, gl.FLOAT, 24, 12],
      [this.lineTints, 4, gl.UNSIGNED_BYTE, 4, 0], [this.widths, 1, gl.FLOAT, 4, 0]], 1);
    this.quadArray = this.#array([[this.quad, 3, gl.FLOAT, 12, 0]], 0);
    this.white = this.#texture(null);
    /** @type {WebGLTexture[]} */
    this.pages = [];
    this.shadowMap = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, shadowSize, shadowSize);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    this.shadowFrame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadowMap, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  #buffer() {
    return /** @type {WebGLBuffer} */ (this.gl.createBuffer());
  }

  /** @param {string} vertex @param {string} fragment */
  #program(vertex, fragment) {
    const {gl} = this;
    const program = /** @type {WebGLProgram} */ (gl.createProgram());
    for (const [kind, source] of /** @type {[number, string][]} */ ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]])) {
      const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(gl.getProgramInfoLog(program) ?? "a shader doesn't link");
    }
    /** @type {Map<string, WebGLUniformLocation | null>} */
    const places = new Map();
    const place = (/** @type {string} */ name) => {
      if (!places.has(name)) {
        places.set(name, gl.getUniformLocation(program, name));
      }
      return places.get(name) ?? null;
    };
    return {program, place};
  }

  /** @param {[WebGLBuffer, number, number, number, number][]} parts @param {number} divisor */
  #array(parts, divisor) {
    const {gl} = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    parts.forEach(([buffer, size, type, stride, offset], i) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
      gl.vertexAttribDivisor(i, divisor);
    });
    gl.bindVertexArray(null);
    return array;
  }

  /** @param {TexImageSource | null} source @returns {WebGLTexture} */
  #texture(source) {
    const {gl} = this;
    const texture = /** @type {WebGLTexture} */ (gl.createTexture());
    gl.bindTexture(gl.TEXTURE_2D, texture);
    if (source) {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, source);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    } else {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([255, 255, 255, 255]));
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    }
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  /** Where each corner lies on the picture of its page. @param {Float32Array} spots */
  setSpots(spots) {
    this.#fill(this.spots, spots, this.gl.STATIC_DRAW);
  }

  /** @param {HTMLCanvasElement[]} pictures one a page */
  setPaint(pictures) {
    this.pages.forEach((page) => this.gl.deleteTexture(page));
    this.pages = pictures.map((picture) => this.#texture(picture));
  }

  /** @param {WebGLBuffer} buffer @param {Float32Array | Uint8Array} data @param {number} use */
  #fill(buffer, data, use) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, /** @type {BufferSource} */ (data), use);
  }

  /** The lamp stands to the left of whoever looks, and above. @param {Camera} camera */
  #lamp(camera) {
    const {azimuth} = camera.direction;
    const sa = Math.sin(azimuth);
    const ca = Math.cos(azimuth);
    const unit = (/** @type {number[]} */ v) => v.map((value) => value / Math.hypot(...v));
    const z = unit([-0.55 * ca + 0.6 * sa, 1.15, 0.55 * sa + 0.6 * ca]);
    const x = unit([z[2], 0, -z[0]]);
    const y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
    const {room, size} = camera;
    const c = [room.x, 0.5 * (room.low + room.high), room.z];
    const s = 1 / (1.05 * size);
    const m = new Float32Array(16);
    [x, y, z.map((value) => -value)].forEach((axis, row) => {
      axis.forEach((value, k) => {
        m[4 * k + row] = s * value;
      });
      m[12 + row] = -s * (axis[0] * c[0] + axis[1] * c[1] + axis[2] * c[2]);
    });
    m[15] = 1;
    return {sun: z, matrix: m};
  }

  /** @param {Picture} picture */
  draw(picture) {
    const {gl} = this;
    const {camera} = picture;
    const lamp = this.#lamp(camera);
    this.#fill(this.corners, picture.corners, gl.STREAM_DRAW);
    this.#fill(this.tints, picture.tints, gl.STREAM_DRAW);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
    gl.viewport(0, 0, shadowSize, shadowSize);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.shadows.program);
    gl.uniformMatrix4fv(this.shadows.place("view"), false, lamp.matrix);
    gl.uniformMatrix4fv(this.shadows.place("lamp"), false, lamp.matrix);
    gl.uniform1f(this.shadows.place("grain"), 0);
    gl.bindVertexArray(this.faceArray);
    const count = picture.corners.length / 6;
    gl.drawArrays(gl.TRIANGLES, 0, count);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap);
    gl.activeTexture(gl.TEXTURE0);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.#drawGround(picture, lamp.matrix);
    gl.useProgram(this.faces.program);
    gl.uniformMatrix4fv(this.faces.place("view"), false, camera.matrix);
    gl.uniformMatrix4fv(this.faces.place("lamp"), false, lamp.matrix);
    gl.uniform1f(this.faces.place("grain"), 0.006 * camera.size);
    gl.uniform3fv(this.faces.place("sun"), lamp.sun);
    gl.uniform3fv(this.faces.place("eye"), camera.eye);
    gl.uniform3fv(this.faces.place("back"), picture.paper);
    gl.uniform1i(this.faces.place("paint"), 0);
    gl.uniform1i(this.faces.place("shadow"), 1);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    this.#drawFaces(picture, 0);
    this.#drawLines(picture, 0, picture.lineCount - picture.markCount, 1, 0.0004);
    if (picture.ghosts) {
      gl.useProgram(this.faces.program);
      gl.colorMask(false, false, false, false);
      gl.polygonOffset(4, 40);
      this.#drawFaces(picture, 2);
      gl.colorMask(true, true, true, true);
      gl.polygonOffset(3, 30);
      gl.enable(gl.BLEND);
      this.#drawFaces(picture, 1);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (picture.markCount > 0) {
      const first = picture.lineCount - picture.markCount;
      gl.disable(gl.DEPTH_TEST);
      this.#drawLines(picture, first, picture.markCount, 0.5, 0);
      gl.enable(gl.DEPTH_TEST);
      this.#drawLines(picture, first, picture.markCount, 1, 0.001);
    }
  }

  /** @param {Picture} picture @param {number} pass */
  #drawFaces(picture, pass) {
    const {gl} = this;
    gl.uniform1i(this.faces.place("pass"), pass);
    gl.bindVertexArray(this.faceArray);
    if (!picture.painted) {
      gl.bindTexture(gl.TEXTURE_2D, this.white);
      gl.drawArrays(gl.TRIANGLES, 0, picture.corners.length / 6);
      return;
    }
    for (const run of picture.runs) {
      gl.bindTexture(gl.TEXTURE_2D, this.pages[run.page] ?? this.white);
      gl.drawArrays(gl.TRIANGLES, 3 * run.from, 3 * (run.to - run.from));
    }
  }

  /** @param {Picture} picture @param {Float32Array} lamp */
  #drawGround(picture, lamp) {
    const {gl} = this;
    const {camera} = picture;
    if (camera.toward[1] < 0.02) {
      return;
    }
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    gl.useProgram(this.ground.program);
    gl.uniformMatrix4fv(this.ground.place("view"), false, camera.matrix);
    gl.uniformMatrix4fv(this.ground.place("lamp"), false, lamp);
    gl.uniform1i(this.ground.place("shadow"), 1);
    gl.uniform1f(this.ground.place("shade"), picture.shade);
    gl.bindVertexArray(this.quadArray);
    const {room} = camera;
    const reach = 2.2 * camera.size;
    const y = -0.002 * camera.size;
    const table = [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([x, z]) => [room.x + reach * x, y, room.z + reach * z]);
    gl.uniform3f(this.ground.place("middle"), room.x, y, room.z);
    gl.uniform1f(this.ground.place("reach"), reach);
    for (const {corners, opacity} of [{corners: table, opacity: 0}, ...picture.sheets]) {
      this.#fill(this.quad, new Float32Array(corners.flat()), gl.STREAM_DRAW);
      gl.uniform4f(this.ground.place("colour"), opacity > 0 ? 1 : 0, opacity > 0 ? 1 : 0, opacity > 0 ? 1 : 0, opacity);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  /** @param {Picture} picture @param {number} first @param {number} count @param {number} opacity @param {number} lift */
  #drawLines(picture, first, count, opacity, lift) {
    const {gl} = this;
    if (count <= 0) {
      return;
    }
    this.#fill(this.ends, picture.lines.subarray(6 * first, 6 * (first + count)), gl.STREAM_DRAW);
    this.#fill(this.lineTints, picture.lineTints.subarray(4 * first, 4 * (first + count)), gl.STREAM_DRAW);
    this.#fill(this.widths, picture.lineWidths.subarray(first, first + count), gl.STREAM_DRAW);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    gl.useProgram(this.lines.program);
    gl.uniformMatrix4fv(this.lines.place("view"), false, picture.camera.matrix);
    gl.uniform2f(this.lines.place("size"), this.canvas.width, this.canvas.height);
    gl.uniform1f(this.lines.place("ratio"), this.canvas.width / picture.camera.width);
    gl.uniform1f(this.lines.place("lift"), lift);
    gl.uniform1f(this.lines.place("opacity"), opacity);
    gl.bindVertexArray(this.lineArray);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}

/** What draws on a canvas, and what it calls when it has begun again. @type {WeakMap<HTMLCanvasElement, {view: WebglView, renewed: (view: WebglView) => void}>} */
const views = new WeakMap();

/**
 * What draws on this canvas: one for all models that it shows one after the other, as programs take long to compile, and
 * what one holds on the graphics card stays there as long as the canvas. It has no paint yet.
 * @param {HTMLCanvasElement} canvas Throws where there is no WebGL 2.
 * @param {(view: WebglView) => void} renewed the graphics card had lost everything: this one draws from now on
 */
export function webglView(canvas, renewed) {
  const known = views.get(canvas);
  if (known) {
    known.renewed = renewed;
    known.view.setPaint([]);
    return known.view;
  }
  const own = {view: new WebglView(canvas), renewed};
  views.set(canvas, own);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => {
    own.view = new WebglView(canvas);
    own.renewed(own.view);
  });
  return own.view;
}
