'use strict';
// The legend of a figure: a button for each trace, a key for each category, and whether an axis is
// logarithmic. legend(spec, panels) is an element, or null where there is nothing to show; `panels` are those
// that plotly draws in. make(tag, properties, ...children) makes an element.
const catenaLegend = make => {
  const SHAPES = {
    circle: 'M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0',
    square: 'M-3.6-3.6h7.2v7.2h-7.2z',
    diamond: 'M0-4.8 4.8 0 0 4.8-4.8 0z',
    'triangle-up': 'M0-4.4 4.4 3.6h-8.8z',
    'triangle-down': 'M0 4.4 4.4-3.6h-8.8z',
    cross: 'M-1.5-4.4h3v2.9h2.9v3h-2.9v2.9h-3v-2.9h-2.9v-3h2.9z',
    star: 'M0-5 1.3-1.6 4.8-1.5 2-.6 2.9 4 0 2-2.9 4-2-.6-4.8-1.5-1.3-1.6z',
    hexagon: 'M-4.4 0-2.2-3.8h4.4l2.2 3.8-2.2 3.8h-4.4z',
  };
  const DASH = {solid: '', dot: '1.5 3', dash: '5 3'};
  function sample(entry) {
    const span = make('span');
    span.innerHTML =
        `<svg width="30" height="12" viewBox="-15 -6 30 12" aria-hidden="true"><path d="M-14 0H14" fill="none" ` +
        `stroke="var(--${entry.colour})" stroke-width="2" stroke-dasharray="${
            DASH[entry.dash] || ''}"/><path d="${SHAPES[entry.marker] || ''}" ` +
        `stroke="var(--${entry.colour})" stroke-width="1.4" fill="var(--${
            entry.hollow ? 'paper' : entry.colour})"/></svg>`;
    return span.firstChild;
  }

  function legend(spec, panels) {
    const bar = make('div', {className: 'legend'});
    const visible = new Map(spec.legend.map(entry => [entry.name, entry.shown]));
    const buttons = new Map();
    const apply = () => {
      for (const [name, button] of buttons) button.setAttribute('aria-pressed', visible.get(name));
      for (const panel of panels) {
        if (!panel.classList.contains('js-plotly-plot')) continue;
        const states = panel.data.map(trace => visible.get(trace.name) === false ? 'legendonly' : true);
        Plotly.restyle(panel, {visible: states});
      }
    };
    if (spec.legend.length > 1)
      for (const entry of spec.legend) {
        const button = make(
            'button', {type: 'button', title: 'Click: show or hide. Double click: this one alone, or all.'},
            sample(entry), entry.name);
        button.dataset.name = entry.name;
        button.setAttribute('aria-pressed', entry.shown);
        button.onclick = () => {
          visible.set(entry.name, !visible.get(entry.name));
          apply();
        };
        button.ondblclick = () => {
          const alone = [...visible].every(([name, on]) => on === (name === entry.name));
          for (const name of visible.keys()) visible.set(name, alone || name === entry.name);
          apply();
        };
        buttons.set(entry.name, button);
        bar.append(button);
      }
    const folded = spec.legend.filter(entry => !entry.shown);
    if (folded.length > 4) {
      const more = make('button', {type: 'button'}, `+ ${folded.length} more`);
      for (const entry of folded) buttons.get(entry.name).hidden = true;
      more.onclick = () => {
        for (const entry of folded) buttons.get(entry.name).hidden = false;
        more.remove();
      };
      bar.append(more);
    }
    for (const entry of spec.categories) {
      const key = make('span', {className: 'key'}, make('i'), entry.name);
      key.firstChild.style.background = `var(--${entry.colour})`;
      bar.append(key);
    }
    const tools = make('span', {className: 'tools'});
    if (spec.legend.length > 3) {
      const all = make('button', {type: 'button'}, 'all');
      all.onclick = () => {
        const on = [...visible.values()].some(value => !value);
        for (const name of visible.keys()) visible.set(name, on);
        apply();
      };
      tools.append(all);
    }
    for (const letter of ['x', 'y']) {
      const axes = spec.panels.map(panel => panel.layout[letter + 'axis']);
      if (axes.some(axis => axis.tickvals) || !axes.some(axis => axis.type === 'log')) continue;
      const button = make(
          'button', {type: 'button', title: `The ${letter} axis logarithmic or linear`}, `${letter}: log`);
      button.onclick = () => {
        const type = button.textContent.endsWith('log') ? 'linear' : 'log';
        button.textContent = `${letter}: ${type}`;
        for (const [at, panel] of panels.entries())
          Plotly.relayout(panel, {
            [letter + 'axis.type']: type,
            [letter + 'axis.autorange']: true,
            [letter + 'axis.dtick']: type === 'log' ? spec.panels[at].layout[letter + 'axis'].dtick : null
          });
      };
      tools.append(button);
    }
    if (tools.childNodes.length) bar.append(tools);
    return bar.childNodes.length ? bar : null;
  }
  return legend;
};
