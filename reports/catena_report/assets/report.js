'use strict';
// Draws the page's figures with plotly where the browser can inflate it, and answers clicks. Nothing is
// fetched.
(() => {
  const $ = (selector, within = document) => within.querySelector(selector);
  const $$ = (selector, within = document) => [...within.querySelectorAll(selector)];
  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  let figures = {};         // what plotly draws, inflated with it
  const drawn = new Map();  // panel element -> {spec, trace names}

  // ---- packed parts of the page
  async function inflate(id) {
    const bytes = Uint8Array.from(atob($('#' + id).textContent), c => c.charCodeAt(0));
    return new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  }
  const inflated = async (id, type) => new Blob([await new Response(await inflate(id)).blob()], {type});

  // What columns.py made of rows.
  function rows({shapes, shape, columns}) {
    const next = shapes.map(() => 0);
    return shape.map(s => {
      const at = next[s]++, values = columns[s].map(c => (Array.isArray(c) ? c : columns[s][c])[at]);
      return Object.fromEntries(shapes[s].map((key, k) => [key, values[k]]));
    });
  }
  const data = async () => (await unpacked('data')).map(run => ({...run, benchmarks: rows(run.benchmarks)}));

  function save(blob, name) {
    const address = URL.createObjectURL(blob);
    make('a', {href: address, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }

  // ---- colours by name
  const MODES = ['auto', 'light', 'dark'];
  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  }
  function coloured(value) {
    if (typeof value === 'string') return value.startsWith('var(--') ? colour(value.slice(6, -1)) : value;
    if (Array.isArray(value))
      return value.every(inner => typeof inner === 'number') ? value : value.map(coloured);
    if (value && typeof value === 'object')
      return Object.fromEntries(Object.entries(value).map(
          ([
            key, inner
          ]) => [key, key === 'text' || key === 'customdata' || key === 'z' ? inner : coloured(inner)]));
    return value;
  }

  // ---- figures
  const legend = catenaLegend(make);
  const CONFIG = {
    displaylogo: false,
    displayModeBar: matchMedia('(hover: none)').matches ? false : 'hover',
    responsive: true,
    toImageButtonOptions: {format: 'svg'},
    modeBarButtonsToRemove: ['lasso2d', 'select2d', 'autoScale2d']
  };
  function layout(panel) {
    const font = {
      family: getComputedStyle(document.documentElement).getPropertyValue('--sans'),
      size: 12,
      color: 'var(--ink)'
    };
    return coloured({
      margin: {l: 58, r: 14, t: 10, b: 46},
      ...panel.layout,
      height: panel.height,
      font,
      hovermode: 'closest',
      showlegend: false,
      paper_bgcolor: 'rgba(0,0,0,0)',
      plot_bgcolor: 'rgba(0,0,0,0)',
      hoverlabel: {
        bgcolor: 'var(--paper)',
        bordercolor: 'var(--faint)',
        align: 'left',
        font: {...font, color: 'var(--ink)'}
      },
      modebar: {bgcolor: 'rgba(0,0,0,0)', color: 'var(--faint)', activecolor: 'var(--c0)'},
    });
  }
  async function draw(figure) {
    const spec = figures[figure.dataset.figure];
    const live = $('.live', figure), grid = make('div', {className: 'panels'});
    grid.style.setProperty('--columns', Math.min(spec.columns, spec.panels.length));
    const plots = spec.panels.map(() => make('div'));
    const keys = legend(spec, plots);
    if (keys) live.append(keys);
    live.append(grid);
    live.hidden = false;
    $('.static', figure).hidden = true;
    grid.setAttribute('role', 'img');
    grid.setAttribute('aria-label', $('h3', figure).textContent);
    grid.setAttribute('aria-describedby', $('.alternative', figure).id);
    for (const [at, panel] of spec.panels.entries()) {
      const holder = make('div', {className: 'panel'}, plots[at]);
      if (panel.least) {
        holder.classList.add('wide');
        plots[at].style.minWidth = panel.least + 'px';
      }
      if (panel.title) holder.prepend(make('h4', {}, panel.title));
      grid.append(holder);
    }
    for (const [at, panel] of spec.panels.entries()) {
      await Plotly.newPlot(plots[at], coloured(panel.data), layout(panel), CONFIG);
      drawn.set(plots[at], panel);
      plots[at].on('plotly_click', event => {
        const point = event.points[0], data = point.data.customdata;
        const chain = data &&
            (Array.isArray(point.pointNumber) ? data[point.pointNumber[0]][point.pointNumber[1]] :
                                                data[point.pointNumber]);
        if (chain) pick(chain);
      });
    }
    figure.dataset.drawn = 'yes';
  }

  function repaint() {
    for (const [plot, panel] of drawn) {
      const states = plot.data.map(trace => trace.visible);
      const ranges = ['xaxis', 'yaxis'].map(axis => ({type: plot.layout[axis].type}));
      const next = layout(panel);
      ['xaxis', 'yaxis'].forEach((axis, at) => Object.assign(next[axis], ranges[at]));
      Plotly.react(
          plot, coloured(panel.data).map((trace, at) => ({...trace, visible: states[at]})), next, CONFIG);
    }
  }

  // ---- a chain picked from a plot
  let picked = null;
  function pick(chain) {
    picked = chain;
    const box = $('#picked'), viewer = window.catenaViewer;
    $('.command', box).textContent = chain.command;
    const shows = viewer && chain.shown;
    $('.what', box).textContent = `${chain.input}, replayed by` +
        (shows && chain.shown !== chain.input ? ` (shown: ${chain.shown}, the nearest of this scene in the page)` : '');
    $('[data-do="show"]', box).hidden = !shows;
    box.hidden = false;
    if (shows) show(chain);
  }
  // The frame is the chain's own: of another chain of its scene the viewer picks one.
  const show = chain =>
      window.catenaViewer.show(chain.shown, chain.shown === chain.input ? chain.frame : undefined);
  $('#picked').onclick = async event => {
    const action = event.target.dataset.do;
    if (action === 'copy') await copy(picked.command, event.target);
    if (action === 'show') {
      show(picked);
      $('#viewer')?.scrollIntoView();
    }
    if (action === 'close') $('#picked').hidden = true;
  };
  async function copy(text, button) {
    await navigator.clipboard.writeText(text);
    const before = button.textContent;
    button.textContent = 'Copied';
    setTimeout(() => {
      button.textContent = before;
    }, 1200);
  }

  // ---- files
  function standalone(figure) {
    const svg = $('.static svg', figure).cloneNode(true);
    svg.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    return new XMLSerializer().serializeToString(svg).replace(/var\(--(\w+)\)/g, (_, name) => colour(name));
  }
  function png(text, name) {
    const image = new Image(), address = URL.createObjectURL(new Blob([text], {type: 'image/svg+xml'}));
    image.onload = () => {
      const canvas = make('canvas', {width: image.width * 3, height: image.height * 3}),
            context = canvas.getContext('2d');
      context.fillStyle = colour('paper');
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob(blob => save(blob, name + '.png'));
      URL.revokeObjectURL(address);
    };
    image.src = address;
  }
  document.addEventListener('click', async event => {
    const button = event.target.closest('button');
    if (!button) return;
    const kind = button.dataset.save;
    if (kind === 'csv') {
      const key = button.closest('.table').id.replace('table-', '');
      save(new Blob([(await unpacked('tables'))[key]], {type: 'text/csv'}), key + '.csv');
    } else if (kind) {
      const figure = button.closest('figure'), text = standalone(figure);
      if (kind === 'svg')
        save(new Blob([text], {type: 'image/svg+xml'}), figure.dataset.figure + '.svg');
      else
        png(text, figure.dataset.figure);
    } else if ('copy' in button.dataset) {
      await copy($('code', button.parentElement).textContent, button);
    } else if (button.id === 'download') {
      save(new Blob([JSON.stringify(await data())], {type: 'application/json'}), 'run.json');
    } else if (button.id === 'theme') {
      const next =
          MODES[(MODES.indexOf(document.documentElement.dataset.theme || 'auto') + 1) % MODES.length];
      document.documentElement.dataset.theme = next;
      button.textContent = `Theme: ${next}`;
      repaint();
    }
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);

  // ---- where the reader is
  const links = new Map($$('nav a').map(link => [link.hash.slice(1), link]));
  const parts = $$('main section');
  function markHere() {
    const line = innerHeight / 4;
    const atEnd = scrollY > 0 && innerHeight + scrollY >= document.documentElement.scrollHeight - 2;
    const now = atEnd ? parts.at(-1) :
                        parts.findLast(part => part.getBoundingClientRect().top <= line) || parts[0];
    for (const [key, link] of links) {
      link.classList.toggle('here', key === now?.id);
      if (key !== now?.id) {
        link.removeAttribute('aria-current');
      } else if (!link.hasAttribute('aria-current')) {
        link.setAttribute('aria-current', 'true');
        const row = link.closest('ol');  // one line that scrolls, in a narrow window
        row.scrollLeft += link.getBoundingClientRect().left - row.getBoundingClientRect().left - row.clientWidth / 3;
      }
    }
  }
  let marking = 0;
  const markSoon = () => {
    marking ||= requestAnimationFrame(() => {
      marking = 0;
      markHere();
    });
  };
  for (const event of ['scroll', 'resize', 'hashchange']) addEventListener(event, markSoon, {passive: true});
  new ResizeObserver(markSoon).observe(document.body);  // figures are drawn, lists open
  markHere();

  // ---- narrow windows show a table's rows as cards, each number beside the name of its column
  for (const table of $$('.cards table')) {
    const names = [...table.tHead.rows[0].cells].map(cell => cell.textContent.trim());
    for (const row of table.tBodies[0].rows)
      for (const [at, cell] of [...row.cells].entries()) cell.dataset.label = names[at];
  }

  // ---- plotly, after the page has been painted; without it or without DecompressionStream the static
  // figures stay
  const unpacked = async id => JSON.parse(await (await inflated(id, 'application/json')).text());
  window.catenaReport = {data, figures: () => figures, pick};
  if ($('#plotly') && window.DecompressionStream) {
    const start = async () => {
      figures = await unpacked('figures');
      const script = make('script', {src: URL.createObjectURL(await inflated('plotly', 'text/javascript'))});
      script.onload = () => {
        const near = new IntersectionObserver(entries => {
          for (const entry of entries)
            if (entry.isIntersecting) {
              near.unobserve(entry.target);
              draw(entry.target);
            }
        }, {rootMargin: '700px 0px'});
        $$('figure[data-figure]').forEach(figure => near.observe(figure));
        document.documentElement.dataset.ready = 'interactive';
      };
      document.head.append(script);
    };
    addEventListener('load', () => requestAnimationFrame(() => setTimeout(start)));
  } else {
    document.documentElement.dataset.ready = 'static';
  }
})();
