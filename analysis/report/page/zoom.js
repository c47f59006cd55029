// Time series of a page can be zoomed: a button beside such a figure draws it anew by dygraphs, from the
// numbers that stand with it. The picture itself is there without script, and on paper.
(function () {
  'use strict';
  const dashes = {solid: null, dashed: [7, 4], dotted: [2, 3]};

  // Series have points of their own; dygraphs wants a row for each x. A gap is NaN, no point is null.
  function rowsOf(panel, banded) {
    const rows = new Map(), n = panel.series.length;
    panel.series.forEach((s, k) => {
      const x = typeof s.x === 'number' ? panel.series[s.x].x : s.x;
      x.forEach((at, i) => {
        if (at === null) return;
        if (!rows.has(at)) rows.set(at, [at].concat(Array(n).fill(banded ? [null, null] : null)));
        const y = s.y[i] === null ? NaN : s.y[i];
        rows.get(at)[k + 1] = banded ? [y, s.sigma ? s.sigma[i] || 0 : 0] : y;
      });
    });
    return [...rows.values()].sort((a, b) => a[0] - b[0]);
  }

  function namesOf(panel) {  // each once
    const names = [];
    panel.series.forEach(s => {
      const name = s.label || panel.y;
      names.push(names.includes(name) ? name + ' (' + (names.length + 1) + ')' : name);
    });
    return names;
  }

  function backdrop(panel) {
    return (context, area, graph) => {
      context.save();
      context.globalAlpha = 0.16;
      for (const band of panel.bands) {
        context.fillStyle = band.colour;
        context.beginPath();
        band.x.forEach((x, i) => context.lineTo(graph.toDomXCoord(x), graph.toDomYCoord(band.low[i])));
        for (let i = band.x.length; i-- > 0;)
          context.lineTo(graph.toDomXCoord(band.x[i]), graph.toDomYCoord(band.high[i]));
        context.fill();
      }
      context.globalAlpha = 1;
      context.strokeStyle = '#555';
      const line = (dash, x1, y1, x2, y2) => {
        context.setLineDash(dash);
        context.beginPath();
        context.moveTo(x1, y1);
        context.lineTo(x2, y2);
        context.stroke();
      };
      for (const at of panel.lines) {
        const y = graph.toDomYCoord(at);
        line([7, 4], area.x, y, area.x + area.w, y);
      }
      for (const at of panel.marks) {
        const x = graph.toDomXCoord(at);
        line([2, 3], x, area.y, x, area.y + area.h);
      }
      context.restore();
    };
  }

  function draw(panel, place) {
    const banded = panel.series.some(s => s.sigma), names = namesOf(panel), series = {};
    panel.series.forEach((s, k) => { series[names[k]] = {strokePattern: dashes[s.stroke]}; });
    return new Dygraph(place, rowsOf(panel, banded), {
      labels: ['x'].concat(names), colors: panel.series.map(s => s.colour), series, title: panel.title,
      xlabel: panel.x, ylabel: panel.y, valueRange: panel.range, errorBars: banded, sigma: 1, fillAlpha: 0.13,
      connectSeparatedPoints: true, strokeWidth: 1.5, legend: 'follow', axisLabelFontSize: 12,
      titleHeight: 20, xLabelHeight: 17, yLabelWidth: 17, underlayCallback: backdrop(panel)});
  }

  function toggled(figure, button, hint) {
    let place = figure.querySelector('.zoomed');
    const show = !place || place.hidden;
    if (!place) {
      place = document.createElement('div');
      place.className = 'zoomed';
      figure.insertBefore(place, figure.querySelector('figcaption'));
      for (const panel of JSON.parse(figure.querySelector('script').textContent)) {
        if (!panel.series.length) continue;
        draw(panel, place.appendChild(document.createElement('div')));
      }
    }
    place.hidden = hint.hidden = !show;
    for (const picture of figure.querySelectorAll('.scroll')) picture.classList.toggle('replaced', show);
    button.textContent = show ? 'Whole picture' : 'Zoom';
  }

  for (const figure of document.querySelectorAll('figure.zoomable')) {
    const button = document.createElement('button'), hint = document.createElement('span');
    button.type = 'button';
    button.textContent = 'Zoom';
    hint.className = 'note';
    hint.hidden = true;
    hint.textContent = ' Drag across to zoom in, with shift to move; double click for all of it.';
    button.addEventListener('click', () => toggled(figure, button, hint));
    figure.prepend(button, hint);
  }
})();
