// Mouse, touch and keys on the stage, and the labels that follow what is drawn there.

function addPointing(viewer) {
  const {scene} = viewer, stage = viewer.part('stage'), tip = viewer.part('tip'), canvas = scene.canvas;
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'img');
  // The wheel scrolls the page until the reader has turned to the chain.
  canvas.addEventListener('focus', () => scene.setWheelZoom(true));
  canvas.addEventListener('blur', () => scene.setWheelZoom(false));
  let pressed = null, wanted = null;
  const hide = () => { tip.hidden = true; };
  const place = (event) => {
    const box = stage.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.focus({preventScroll: true});
    scene.setWheelZoom(true);
    scene.stopFlight();
    pressed = place(event);
    hide();
  });
  canvas.addEventListener('pointerup', (event) => {
    const at = place(event);
    if (!pressed || Math.hypot(at.x - pressed.x, at.y - pressed.y) > 5) return void (pressed = null);
    pressed = null;
    const sphere = scene.pick(at.x, at.y);
    if (sphere >= 0) viewer.pairList.pickSphere(sphere);
  });
  canvas.addEventListener('dblclick', (event) => {
    const at = place(event), sphere = scene.pick(at.x, at.y);
    if (sphere < 0) return;
    const row = viewer.frame.spheres.subarray(4 * sphere, 4 * sphere + 4);
    scene.flyTo([row[0], row[1], row[2]], 2 * row[3] || viewer.placement.reach / 100);
  });
  canvas.addEventListener('pointerleave', () => { wanted = null; hide(); });
  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'touch' || event.buttons) return hide();
    if (!wanted) requestAnimationFrame(() => {
      if (!wanted) return;
      const at = wanted, sphere = scene.pick(at.x, at.y);
      wanted = null;
      tip.hidden = sphere < 0;
      if (sphere < 0) return;
      tip.textContent = `sphere ${sphere}: ${plural(viewer.touching[sphere], 'collision')}, radius ` +
                        shortNumber(viewer.frame.spheres[4 * sphere + 3]);
      tip.style.transform = `translate(${Math.min(at.x + 14, stage.clientWidth - tip.offsetWidth - 6)}px,` +
                            `${Math.max(at.y - 34, 4)}px)`;
    });
    wanted = place(event);
  });
}

function addKeys(viewer) {
  const actions = {
    ' ': () => viewer.playback.toggle(),
    ArrowRight: () => viewer.playback.step(1),
    ArrowLeft: () => viewer.playback.step(-1),
    ArrowDown: () => viewer.pairList.pick(viewer.pairList.place + 1),
    ArrowUp: () => viewer.pairList.pick(viewer.pairList.place - 1),
    '+': () => viewer.scene.zoom(0.8),
    '-': () => viewer.scene.zoom(1.25),
    r: () => viewer.reset(),
    Escape: () => viewer.select(null),
  };
  viewer.part('stage').addEventListener('keydown', (event) => {
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey || event.target.closest('button')) return;
    event.preventDefault();
    action();
  });
}

// After each picture: labels at the two spheres of the pair chosen, and the axes in the corner.
function drawLabels(viewer) {
  const {scene, selected} = viewer;
  viewer.part('tip').hidden = true;
  viewer.part('legend-shell').hidden = !scene.shells;
  ['i', 'j'].forEach((name) => {
    const label = viewer.part(`label-${name}`);
    label.hidden = !selected;
    if (!selected) return;
    const [own, other] = name === 'i' ? selected.rows : [...selected.rows].reverse();
    const at = scene.project(own), from = scene.project(other);
    label.textContent = selected[name];
    label.hidden = !at.before;
    const length = Math.hypot(at.x - from.x, at.y - from.y);
    const [dx, dy] = length > 1 ? [(at.x - from.x) / length, (at.y - from.y) / length] : [0, name === 'i' ? -1 : 1];
    label.style.transform = `translate(-50%,-50%) translate(${at.x + dx * 16}px,${at.y + dy * 16}px)`;
  });
  for (const {name, x, y, z} of scene.axes()) {
    const line = viewer.part(`axis-${name}`), text = viewer.part(`axis-name-${name}`);
    line.setAttribute('x2', 18 * x);
    line.setAttribute('y2', -18 * y);
    text.setAttribute('x', 25 * x);
    text.setAttribute('y', -25 * y);
    text.style.opacity = line.style.opacity = 0.65 + 0.35 * Math.max(-0.8, z);
  }
}
