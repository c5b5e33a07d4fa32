// Nothing is unpacked before the reader comes near: the page opens as fast without a viewer.

async function unpacked(id) {
  const stored = bytesOf(document.getElementById(id).textContent.trim());
  const stream = new Blob([stored]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).text();
}

async function makeScene(stage, onDraw) {
  const noWebGl = 'This browser offers no WebGL 2, so the chain is drawn flat and cannot be turned; ' +
                  'frames, pairs and levels work.';
  try {
    const script = document.createElement('script');
    script.textContent = await unpacked('catena-three');
    document.head.append(script);
    const scene = GlScene.create(stage, onDraw);
    if (scene) return [scene, ''];
  } catch (error) {
    if (typeof DecompressionStream !== 'undefined') throw error;
  }
  return [new FlatScene(stage, onDraw), noWebGl];
}

function startViewer() {
  const root = document.getElementById('catena-viewer');
  root.dataset.js = 'yes';     // its controls would do nothing without
  readPalette(root);
  let entries = null, started = null;
  const read = async () => entries = entries || JSON.parse(await unpacked('catena-views'));
  const start = () => started = started || (async () => {
    const viewer = new Viewer(root, (await read()).map((entry) => new View(entry)));
    const [scene, notice] = await makeScene(viewer.part('stage'), () => drawLabels(viewer));
    viewer.start(scene, notice);
    window.catenaViewer.viewer = viewer;
    root.dataset.ready = 'yes';
    return viewer;
  })().catch((error) => {
    const notice = root.querySelector('[data-part="notice"]');
    notice.textContent = `The viewer cannot be shown (${error.message || error}).`;
    notice.hidden = false;
    root.dataset.ready = 'failed';
    return null;
  });
  const nearby = new IntersectionObserver((sights) => {
    if (sights.some((sight) => sight.isIntersecting)) nearby.disconnect(), start();
  }, {rootMargin: '400px'});
  nearby.observe(root);
  // show() brings a chain before the reader's eyes; false where the page does not hold it.
  window.catenaViewer = {
    async show(input, frame) {
      const index = (await read()).findIndex((entry) => entry.input === input);
      if (index < 0) return false;
      root.scrollIntoView({block: 'start'});
      const viewer = await start();
      if (viewer) viewer.setView(index, frame);
      return Boolean(viewer);
    },
  };
}
