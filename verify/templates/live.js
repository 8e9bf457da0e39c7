"use strict";
for (const figure of document.querySelectorAll("[data-live]")) {
  const part = name => figure.querySelector(`[data-part="${name}"]`);
  const [canvas, controls, told, speed, turn, choice] = ["canvas", "controls", "told", "speed", "turn", "level"].map(part);
  // States: "" still at it, "absent" (not in this browser), "failed", "equal", "differs".
  const end = (state, text) => {
    figure.dataset.live = state;
    const sign = part(state);
    if (sign) sign.hidden = false;
    told.textContent = text;
  };
  // One instruction that only a browser with SIMD takes.
  const simd = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11);
  const plain = name => Uint8Array.from(atob(part(name).content.textContent), c => c.charCodeAt(0));
  const unpacked = async name => {
    const stream = new Blob([plain(name)]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };
  const lacks = typeof WebAssembly !== "object" ? "no WebAssembly" : !WebAssembly.validate(simd) ? "no SIMD in WebAssembly"
    : typeof DecompressionStream !== "function" ? "nothing that unpacks gzip" : "";

  const start = async () => {
    const [module, scene, first] = [await unpacked("module"), await unpacked("scene"), plain("camera")];
    const { instance: { exports: api } } = await WebAssembly.instantiate(module);
    // What a function gives is an address; it is asked first, since memory that has grown is another buffer.
    const bytes = (address, length) => new Uint8Array(api.memory.buffer, address, length);
    const text = () => new TextDecoder().decode(bytes(api.message(), api.message_bytes()));
    const yes = answer => { if (!answer) throw new Error(text()); return answer; };
    const put = (what, take) => {
      bytes(yes(api.inbox(what.length)), what.length).set(what);
      yes(take());
    };
    put(scene, api.set_scene);
    const levels = Array.from({ length: api.levels() }, (_, level) => (yes(api.name_level(level)), text()));

    // The camera turns about the point in the middle of the picture that is as far away as the middle of the scene.
    const numbers = new DataView(first.buffer), vector = at => [0, 1, 2].map(i => numbers.getFloat32(4 * (at + i), true));
    const [eye, corner, du, dv] = [0, 3, 6, 9].map(vector), [width, height] = [48, 52].map(at => numbers.getUint32(at, true));
    const add = (u, v, times) => u.map((x, i) => x + times * v[i]), dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const unit = v => { const most = Math.max(...v.map(Math.abs)), w = v.map(x => x / most); return w.map(x => x / Math.sqrt(dot(w, w))); };
    const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const rotated = (v, axis, angle) => {
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      return add(add(v.map(x => x * cos), cross(axis, v), sin), axis, dot(axis, v) * (1 - cos));
    };
    const right = unit(du), down = unit(dv), ahead = unit(add(add(corner, du, width / 2), dv, height / 2));
    const spheres = new DataView(scene.buffer), low = [Infinity, Infinity, Infinity], high = low.map(x => -x);
    for (let at = 16; at < scene.length; at += 20) for (let i = 0; i < 3; i++) {
      const x = spheres.getFloat32(at + 4 * i, true);
      low[i] = Math.min(low[i], x);
      high[i] = Math.max(high[i], x);
    }
    const middle = low.map((x, i) => x > high[i] ? eye[i] + ahead[i] : x / 2 + high[i] / 2);
    const depth = dot(add(middle, eye, -1), ahead), pivot = depth > 0 ? add(eye, ahead, depth) : middle;
    const home = { across: 0, along: 0, far: 1 };
    let at = { ...home }, level = levels.length - 1, times = [], due = 0, turning = 0;
    const camera = () => {
      if (Object.keys(home).every(key => at[key] === home[key])) return first;
      const moved = first.slice(), view = new DataView(moved.buffer);
      const turned = v => rotated(rotated(v, right, at.along), down, at.across);
      const stand = add(pivot, turned(add(eye, pivot, -1)), at.far);
      [stand, ...[corner, du, dv].map(turned)].flat().forEach((x, i) => view.setFloat32(4 * i, x, true));
      return moved;
    };

    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d", { alpha: false });
    const draw = () => {
      put(camera(), api.set_camera);
      const begin = performance.now();
      yes(api.render(level));
      const end = performance.now();
      const colors = bytes(api.rgba(), 4 * api.pixels());
      context.putImageData(new ImageData(new Uint8ClampedArray(colors.buffer, colors.byteOffset, colors.length), width, height), 0, 0);
      times = [...times.slice(-29), end - begin];
      const mean = times.reduce((sum, x) => sum + x) / times.length;
      const rate = mean > 0 ? `${(width * height / mean / 1000).toPrecision(3)} Mray/s` : "too quick for this clock";
      speed.textContent = `${mean.toFixed(1)} ms a frame, ${rate}`;
    };

    // The first frame at each level, held against the native one.
    const hashes = levels.map((_, number) => {
      level = number;
      draw();
      return [...bytes(yes(api.hash()), 32)].map(x => x.toString(16).padStart(2, "0")).join("");
    });
    times = [];
    draw();
    levels.forEach((name, number) => choice.add(new Option(name, number, false, number === level)));
    const wrong = hashes.findIndex(hash => hash !== figure.dataset.hash);
    for (const thing of [canvas, controls]) thing.hidden = false;
    if (wrong < 0) {
      end("equal", `Traced in this browser at ${levels.join(" and ")}, the first frame has every id, t and colour of the one that was traced at ` +
        `${figure.dataset.level} when the page was made. SHA-256 of both: ${figure.dataset.hash}`);
    } else {
      end("differs", `Traced in this browser at ${levels[wrong]}, the first frame is not the one that was traced at ${figure.dataset.level} ` +
        `when the page was made. SHA-256 here: ${hashes[wrong]}, there: ${figure.dataset.hash}`);
    }

    const show = () => {
      if (!due) due = requestAnimationFrame(() => {
        due = 0;
        try { draw(); } catch (error) { speed.textContent = `no such frame: ${error.message}`; }
      });
    };
    const move = change => {
      at = { ...at, ...change };
      at.along = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, at.along));
      at.far = Math.max(0.01, Math.min(1000, at.far));
      show();
    };
    const stop = () => { cancelAnimationFrame(turning); turning = 0; turn.textContent = "Turn"; };
    const go = before => now => {
      move({ across: at.across + (now - before) * 0.0006 });
      turning = requestAnimationFrame(go(now));
    };
    turn.addEventListener("click", () => {
      if (turning) { stop(); return; }
      turning = requestAnimationFrame(go(performance.now()));
      turn.textContent = "Stop";
    });
    part("back").addEventListener("click", () => { stop(); move(home); });
    choice.addEventListener("change", () => { level = Number(choice.value); times = []; show(); });

    const keys = {
      ArrowLeft: step => ({ across: at.across + step }), ArrowRight: step => ({ across: at.across - step }),
      ArrowUp: step => ({ along: at.along - step }), ArrowDown: step => ({ along: at.along + step }),
      "+": step => ({ far: at.far / (1 + step) }), "=": step => ({ far: at.far / (1 + step) }), "-": step => ({ far: at.far * (1 + step) }),
      0: () => home, Home: () => home,
    };
    canvas.addEventListener("keydown", event => {
      const change = !event.ctrlKey && !event.altKey && !event.metaKey && keys[event.key];
      if (!change) return;
      event.preventDefault();
      stop();
      move(change(event.shiftKey ? 0.02 : 0.1));
    });
    // One pointer turns; of two, their distance moves nearer and farther.
    const held = new Map(), apart = () => { const [p, q] = [...held.values()]; return Math.hypot(p[0] - q[0], p[1] - q[1]); };
    canvas.addEventListener("pointerdown", event => {
      stop();
      held.set(event.pointerId, [event.clientX, event.clientY]);
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", event => {
      if (!held.has(event.pointerId)) return;
      const [x, y] = held.get(event.pointerId), before = held.size === 2 ? apart() : 0;
      held.set(event.pointerId, [event.clientX, event.clientY]);
      if (held.size === 1) {
        const scale = 4 / canvas.clientWidth;
        move({ across: at.across - (event.clientX - x) * scale, along: at.along + (event.clientY - y) * scale });
      } else if (held.size === 2 && before > 0) {
        move({ far: at.far * before / Math.max(apart(), 1) });
      }
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => held.delete(event.pointerId));
    // A wheel moves the page, unless the picture was chosen before.
    canvas.addEventListener("wheel", event => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      move({ far: at.far * Math.exp(Math.max(-100, Math.min(100, event.deltaY)) / 500) });
    }, { passive: false });
  };

  if (lacks) {
    end("absent", `The live view needs more than this browser has: ${lacks}. The picture is a still one.`);
  } else {
    start().catch(error => end("failed", `The live view has failed: ${error.message}. The picture is a still one.`));
  }
}
