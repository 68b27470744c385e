#!/usr/bin/env python3
"""Opens report.html of folders of results in headless Chromium and compares what it shows with history.csv.

report.py FOLDER… [--shots DIR]: for every folder no message on the console, nothing fetched, axes with units, values of all
charts over time, the value under the pointer, units that switch, keys that move and zoom. With --shots also pictures, as on
a desk, on a telephone, in the dark and printed."""
import base64, cmath, csv, json, math, os, re, shutil, subprocess, sys, tempfile, time

CHROMIUM = next((found for name in ('chromium', 'chromium-browser', 'google-chrome') if (found := shutil.which(name))), None)
FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--remote-debugging-pipe', '--no-first-run', '--hide-scrollbars',
         '--disable-extensions', '--disable-background-networking', '--force-color-profile=srgb', '--enable-unsafe-swiftshader']


class Browser:
    """Chromium over its pipe for tools: messages of JSON, each ended by a zero."""

    def __init__(self):
        self.profile = tempfile.mkdtemp()
        (to_read, self.to), (self.come, from_write) = os.pipe(), os.pipe()

        def pipes():
            # Chromium reads from 3 and writes to 4.
            os.dup2(to_read, 13), os.dup2(from_write, 14)
            os.dup2(13, 3), os.dup2(14, 4)

        self.process = subprocess.Popen([CHROMIUM, *FLAGS, f'--user-data-dir={self.profile}', 'about:blank'], preexec_fn=pipes,
                                        close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read), os.close(from_write)
        self.rest, self.number, self.events, self.session = b'', 0, [], None
        target = self.send('Target.createTarget', url='about:blank')['targetId']
        self.session = self.send('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            self.send(f'{domain}.enable')

    def message(self):
        while b'\0' not in self.rest:
            read = os.read(self.come, 1 << 20)
            if not read:
                raise SystemExit('Chromium has ended')
            self.rest += read
        one, self.rest = self.rest.split(b'\0', 1)
        return json.loads(one)

    def send(self, method, **params):
        self.number += 1
        own = {'id': self.number, 'method': method, 'params': params}
        if self.session:
            own['sessionId'] = self.session
        os.write(self.to, json.dumps(own).encode() + b'\0')
        while True:
            message = self.message()
            if message.get('id') == self.number:
                if 'error' in message:
                    raise SystemExit(f'{method}: {message["error"]}')
                return message['result']
            self.events.append(message)

    def wait(self, event):
        while not any(own.get('method') == event for own in self.events):
            self.events.append(self.message())

    def run(self, script):
        """What a script gives, as JSON."""
        found = self.send('Runtime.evaluate', expression=script, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in found:
            raise SystemExit(f'{script}: {found["exceptionDetails"]}')
        return found['result'].get('value')

    def open(self, path, width, height=900, dark=False):
        self.events = []
        self.send('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.send('Emulation.setEmulatedMedia', features=[{'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}])
        self.send('Page.navigate', url='file://' + os.path.abspath(path))
        self.wait('Page.loadEventFired')
        self.run('new Promise((done) => setTimeout(done, 300))')

    def close(self):
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)


def table(path):
    with open(path, newline='') as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def near(a, b, scale):
    # Seven digits, of a value and of the largest.
    return abs(a - b) <= 2e-7 * scale + 1e-30


def check(browser, folder):
    """Everything of one page; how many values were compared."""
    path = os.path.join(folder, 'report.html')
    browser.open(path, 1400)
    said = [own for own in browser.events if own.get('method') in ('Runtime.consoleAPICalled', 'Runtime.exceptionThrown', 'Log.entryAdded')]
    # Without a graphics card the browser itself reads pixels back, and complains of that.
    said = [own for own in said if 'GL Driver Message' not in json.dumps(own)]
    assert not said, f'{path}: {json.dumps(said)[:2000]}'
    asked = [own['params']['request']['url'] for own in browser.events if own.get('method') == 'Network.requestWillBeSent']
    asked = [url for url in asked if not url.startswith('data:')]
    assert asked == ['file://' + os.path.abspath(path)], asked
    # All are drawn, so that all can be read back.
    browser.run('whirl.charts.forEach((own) => own.render())')
    charts = browser.run('whirl.charts.map((own) => ({ id: own.spec.id, ...own.values() }))')
    for chart in charts:
        for axis in (chart['x'], chart['y']):
            assert '(' in axis or any(word in axis for word in ('|E| / c', 'revolutions', 'iterations', 'log decrement', 'share of what is allowed', 'order', 'body', 'turn', 'ratio')), (chart['id'], axis)
        for ends in chart['view'].values():
            assert all(math.isfinite(own) for own in ends) and ends[1] > ends[0], chart
    compared = in_space(browser, folder) + lateral(browser, folder, charts)
    if os.path.exists(os.path.join(folder, 'history.csv')):
        compared += histories(browser, folder, charts)
    switches(browser)
    turns(browser)
    return len(charts), compared


def histories(browser, folder, charts):
    rows, compared = table(os.path.join(folder, 'history.csv')), 0
    groups = {own['title']: own for own in browser.run('whirl.data.about.groups')}
    every = browser.run('whirl.data.run.histories.every')
    for chart in charts:
        group = groups.get(chart['title'])
        if not chart['id'].startswith('history-') or not group:
            continue
        for line, (column, _) in zip(chart['series'], group['lines']):
            known = [own * group['factor'] for own in rows[column]]
            scale = max(map(abs, known), default=0.0)
            parts = [known[k:k + every] for k in range(0, len(known), every)]
            assert len(line['x']) == len(parts), (column, len(line['x']), len(parts))
            for k, part in enumerate(parts):
                if line.get('y'):
                    assert near(line['y'][k], part[0], scale) and line['x'][k] == rows['t_s'][k], (column, k)
                else:
                    assert near(line['least'][k], min(part), scale) and near(line['most'][k], max(part), scale), (column, k)
            compared += len(parts)
    compared += over_angle(browser, rows, charts) + envelopes(browser, rows, charts) + film_maps(browser, rows)
    compared += strongest(browser, rows)
    # What stands at the pointer.
    shown = [own for own in charts if own['id'].startswith('history-') and own['title'] in groups]
    if shown:
        own = shown[0]
        spot = browser.run(f'''(() => {{ const chart = whirl.charts.find((own) => own.spec.id === {json.dumps(own['id'])});
            chart.figure.scrollIntoView(); const box = chart.svg.getBoundingClientRect();
            return [box.left + box.width * 0.6, box.top + box.height * 0.4]; }})()''')
        browser.send('Input.dispatchMouseEvent', type='mouseMoved', x=spot[0], y=spot[1])
        time.sleep(0.1)
        at, legend = browser.run(f'''(() => {{ const chart = whirl.charts.find((own) => own.spec.id === {json.dumps(own['id'])});
            return [chart.cursor, [...chart.legend.querySelectorAll('b')].map((own) => own.textContent)]; }})()''')
        assert at is not None, own['id']
        column = groups[own['title']]['lines'][0][0]
        k = min(range(len(rows['t_s'])), key=lambda k: abs(rows['t_s'][k] - at))
        part = [value * groups[own['title']]['factor'] for value in rows[column][max(k - every, 0):k + every + 1]]
        values = [float(text.replace('−', '-')) for text in legend[1].split(' … ')]
        for value in values:
            assert min(part) - 1e-4 * abs(value) <= value <= max(part) + 1e-4 * abs(value), (own['id'], legend, part)
    return compared


def over_angle(browser, rows, charts):
    """Charts over the angle: the last rows, by the angle that is left."""
    groups, compared = browser.run('whirl.data.about.groups'), 0
    for turned in browser.run('whirl.data.run.turned.map((own) => ({ group: own.group, revolutions: own.revolutions }))'):
        group = groups[turned['group']]
        chart = next((own for own in charts if own['id'].startswith('angle-') and own['title'] == group['title']), None)
        if chart is None:
            # What is zero over all of them has no chart.
            last = first_of(rows[group['angle']], turned['revolutions'])
            assert all(value == 0 for column, _ in group['lines'] for value in rows[column][last:]), group['title']
            continue
        turns = [abs(own) / (2 * math.pi) for own in rows[group['angle']]]
        for line, (column, _) in zip(chart['series'], group['lines']):
            known = [own * group['factor'] for own in rows[column]]
            scale = max(map(abs, known))
            span = next(k for k in range(1, len(turns)) if turns[-1] - turns[-1 - k] >= turned['revolutions'] - 1e-9)
            every = max(round(span / len(line['x'])), 1)
            # It ends where θ is a multiple of 360°, and in each row the angle is that since such a place.
            ends = [k for k in range(len(turns)) if abs((turns[k] - line['x'][-1] / 360) % 1 - 0.5) > 0.5 - 2e-6]
            count = len(line['x'])
            ripple = re.search(r'less its mean, (\S+)', line['name'])
            if ripple:
                assert near(sum(line['y']) / count, 0, scale), (column, line['name'])
            def fits(end):
                shown = [known[end - (k - 1) * every] for k in range(count, 0, -1)]
                # The mean of what is shown, which its legend tells to five digits.
                mean = sum(shown) / count if ripple else 0
                if ripple and not math.isclose(mean, float(ripple.group(1).replace('−', '-')), rel_tol=6e-5):
                    return False
                return all(near(own + mean, value, 2 * scale if ripple else scale) for own, value in zip(line['y'], shown))
            end = next((own for own in reversed(ends) if fits(own)), None)
            assert end is not None, (column, line['x'][-1])
            for k in range(1, len(line['x']) + 1):
                degrees = 360 * (turns[end - (k - 1) * every] - turns[end]) + line['x'][-1]
                assert math.isclose(line['x'][-k], degrees, abs_tol=2e-4 * max(1, turned['revolutions'])), (column, k, line['x'][-k], degrees)
                compared += 1
    return compared


def film_maps(browser, rows):
    """The extremes of films at each instant, as their legends tell them."""
    compared = 0
    for key, column, unit in (('pressure_mpa', 'pmax_{}_MPa', 'MPa'), ('gap_um', 'hmin_{}_um', 'µm')):
        told = browser.run(f'''(() => {{
            const [kind, when] = document.querySelectorAll('#films select');
            if (!kind) return [];
            const change = (box, value) => {{ box.value = value; box.dispatchEvent(new Event('change')); }};
            change(kind, {json.dumps(key)});
            return [...when.options].map((own) => {{ change(when, own.value); return [parseFloat(own.textContent), whirl.charts.filter((chart) => chart.figure.closest('#films')).map((chart) => [chart.spec.title, chart.legend.textContent])]; }});
        }})()''')
        for at, legends in told:
            k = min(range(len(rows['t_s'])), key=lambda k: abs(rows['t_s'][k] - at))
            for title, legend in legends:
                known = rows.get(column.format(title.split(':')[0]))
                if known is None:
                    continue
                own = float(re.search(rf'(?:largest|smallest): (\S+) {unit}', legend).group(1))
                assert math.isclose(own, known[k], rel_tol=6e-4), (title, at, own, known[k])
                compared += 1
    return compared


def strongest(browser, rows):
    """The strongest motion: the semi-axis at the frequency that is told, by a sum over the last cycles with a Hann window."""
    told = browser.run('''(() => { const own = [...document.querySelectorAll('.facts div')].find((one) => one.querySelector('dt').textContent === 'strongest motion');
        return own ? own.querySelector('small').textContent : ''; })()''')
    found = re.fullmatch(r'(.+): (\S+) µm 0-pk at (\S+) Hz', told)
    if not found:
        return 0
    title, amplitude, hertz = found.group(1), float(found.group(2)), float(found.group(3))
    signal = next(own for own in browser.run('whirl.data.about.signals') if own['title'] == title and own['unit'] == 'µm')
    cycle, times = browser.run('whirl.data.summary.cycle_s'), rows['t_s']
    first = next(k for k, t in enumerate(times) if t >= times[-1] - 16 * cycle)
    count = len(times) - first
    sides = [0, 0]
    total = 0
    for k in range(count):
        weight = 0.5 * (1 - math.cos(2 * math.pi * (k + 0.5) / count))
        values = [rows[column][first + k] for column, _ in signal['columns']]
        z = complex(values[0], values[1] if len(values) > 1 else 0)
        total += weight
        for side, sign in enumerate((-1, 1)):
            sides[side] += weight * z * cmath.exp(sign * 2j * math.pi * hertz * (times[first + k] - times[-1]))
    known = sum(abs(own) for own in sides) / total
    assert math.isclose(amplitude, known, rel_tol=0.02), (told, known)
    return 1


def first_of(theta, revolutions):
    return next(k for k in range(len(theta)) if abs(theta[-1] - theta[k]) <= 2 * math.pi * revolutions * (1 + 1e-6))


def envelopes(browser, rows, charts):
    """Extremes of revolutions and of their neighbours: all of the history but a last one that lacks more than a row."""
    compared = 0
    for chart in charts:
        if not chart['id'].startswith('envelope-'):
            continue
        signal = next(own for own in browser.run('whirl.data.about.signals') if f"{own['title']}: {own['quantity']}" == chart['title'])
        theta = rows[signal['angle']]
        revolutions = browser.run('whirl.data.run.envelopes.map((own) => own.revolutions)')[0]
        sense = 1 if theta[-1] > theta[0] else -1
        extremes = {}
        for (column, axis) in signal['columns']:
            found = {}
            for angle, value in zip(theta, rows[column]):
                turn = math.floor(sense * (angle - theta[0]) / (2 * math.pi * revolutions) + 1e-9)
                least, most = found.get(turn, (value, value))
                found[turn] = (min(least, value), max(most, value))
            whole, row = abs(theta[-1] - theta[0]) / (2 * math.pi * revolutions), abs(theta[-1] - theta[-2]) / (2 * math.pi * revolutions)
            turns = list(found.values()) if math.ceil(whole - 1e-9) - whole <= row else list(found.values())[:-1]
            beside = [turns[max(k - 1, 0):k + 2] for k in range(len(turns))]
            extremes[axis] = [(min(own[0] for own in all), max(own[1] for own in all)) for all in beside]
        for line in chart['series']:
            which, axis = line['name'].split(' ')
            known = [own[which == 'largest'] for own in extremes[axis]]
            values = line['y'] if line['x'][0] <= line['x'][-1] and abs(line['y'][0] - known[0]) <= abs(line['y'][-1] - known[0]) else line['y'][::-1]
            assert len(values) == len(known), (line['name'], len(values), len(known))
            scale = max(map(abs, known))
            # Rows at the very end of a turn may be of either by rounding.
            apart = sum(not near(a, b, scale) for a, b in zip(values, known))
            assert apart <= 0.02 * len(known), (chart['id'], line['name'], apart)
            compared += len(known)
    return compared


def rows_of(path):
    with open(path, newline='') as file:
        return list(csv.DictReader(file))


# Points of tables by what they are: nodes of a body around it at a z (m).
RINGS = {'output.first': ('rotor', 0.0), 'output.last': ('rotor', 1.0)}
# Their mean displacement, as the shader has it.
MEAN = """((scene, name, z) => { const own = scene.bodies.find((one) => one.body.name === name); const sum = [0, 0, 0]; const [c, s] = [Math.cos(scene.angle), Math.sin(scene.angle)];
let count = 0; for (let k = 0; k < own.nodes; k++) { if (Math.abs(own.points[3 * k + 2] - z) > 1e-6) continue; count++;
for (let axis = 0; axis < 3; axis++) sum[axis] += c * own.parts[3 * k + axis] + s * own.parts[3 * (own.nodes + k) + axis]; }
return sum.map((one) => one / count); })"""


def in_space(browser, folder):
    """Modes and orbits: what is played is what the tables of their analyses have."""
    scenes = browser.run('whirl.scenes.map((own) => own.name || null)')
    compared = 0
    for place, name in enumerate(scenes):
        if not name:
            continue
        own = f'whirl.scenes[{place}]'
        count = browser.run(f'{own}.canvas.closest("section").querySelector("select").options.length')
        content = json.load(open(os.path.join(folder, f'{name}.motions.json')))
        assert count == len(content['motions']), (count, name)
        table = rows_of(os.path.join(folder, f'{name}.csv'))
        for k, motion in enumerate(content['motions']):
            browser.run(f"""(() => {{ const box = {own}.canvas.closest("section").querySelector("select"); box.value = "{k}"; box.dispatchEvent(new Event("change")); }})()""")
            said = browser.run(f'[...{own}.canvas.closest("section").querySelectorAll("p.soft")].map((one) => one.textContent).join(" ")')
            assert motion['name'] in said and motion['words'] in said, (said, motion['name'])
            if motion['metres'] is None:
                # The point that gets furthest is there at first.
                assert math.isclose(browser.run(f'{own}.reach'), 1, rel_tol=1e-4)
                compared += 1
                continue
            order = float(motion['group'].split('X')[0])
            for row in table:
                if row['point'] not in RINGS or float(row['order']) != order:
                    continue
                body, z = RINGS[row['point']]
                if not math.isclose(float(row['speed_rpm']), motion['rpm'], rel_tol=1e-9):
                    continue
                for degrees in (0, 50, 200):
                    browser.run(f'{own}.angle = {math.radians(degrees)}')
                    found = browser.run(f'{MEAN}({own}, {json.dumps(body)}, {z})')
                    for axis, letter in enumerate('xy'):
                        known = 1e-6 * float(row[f'{letter}_um']) * math.cos(math.radians(degrees + float(row[f'{letter}_phase_deg'])))
                        assert abs(found[axis] - known) <= 2e-5 * motion['largest'], (row['point'], motion['name'], found, known)
                        compared += 1
        before = browser.run(PIXELS.replace('whirl.scene', own))
        browser.run(f'{own}.angle += 1.5')
        assert browser.run(PIXELS.replace('whirl.scene', own)) != before, f'{name} does not move'
        pressed = browser.run(f'(() => {{ const button = {own}.canvas.closest("section").querySelector("button"); button.click(); const said = button.textContent; button.click(); return said; }})()')
        assert pressed == 'Stop', pressed
    return compared


def lateral(browser, folder, charts):
    """The table of a lateral analysis with what passes, and what probes read."""
    analyses = browser.run('whirl.data.analyses ? whirl.data.analyses.analyses : []')
    compared = 0
    for name in (own['name'] for own in analyses if own['kind'] == 'lateral'):
        rows = rows_of(os.path.join(folder, f'{name}.csv'))
        part = f'document.getElementById("analysis-{name}")'
        for word, label in (('NO', 'fails'), ('yes', 'passes')):
            shown = browser.run(f'{part}.querySelectorAll("td.{label}").length')
            assert shown == sum(row['pass'] == word for row in rows), (word, shown)
        said = browser.run(f'document.getElementById("verdict-{name}").textContent')
        assert said.startswith('Does not pass' if any(row['pass'] == 'NO' for row in rows) else 'Passes'), said
        cells = browser.run(f'[...{part}.querySelectorAll("tbody tr")].map((row) => row.textContent)')
        for row in rows:
            assert any(row['clause'] in cell and row['quantity'] in cell and row['place'] in cell for cell in cells), row
        readings = rows_of(os.path.join(folder, f'{name}.response.csv'))
        titles = {f'Probes, unbalance {row["unbalance"]}, {row["variant"]}': row for row in readings}
        found = [chart for chart in charts if chart['title'] in titles]
        assert len(found) == len(titles), [chart['title'] for chart in charts]
        for chart in found:
            own = titles[chart['title']]
            own = [row for row in readings if (row['variant'], row['unbalance']) == (own['variant'], own['unbalance'])]
            for line in chart['series']:
                known = [row for row in own if row['place'].replace(' deg', '°') == line['name']]
                for row, x, y in zip(known, line['x'], line['y']):
                    assert math.isclose(float(row['speed_rpm']), x) and math.isclose(float(row['unscaled_um_pkpk']), y), (row, x, y)
                    compared += 1
    return compared


def switches(browser):
    """Units, amplitudes and keys."""
    values = 'whirl.charts.map((own) => own.values())'
    before = browser.run(values)
    browser.run('document.getElementById("units").value = "us"; document.getElementById("units").dispatchEvent(new Event("change"))')
    after = browser.run(values)
    factors = {'(µm)': ('(mil)', 1 / 25.4), '(N)': ('(lbf)', 1 / 4.4482216152605)}
    for one, other in zip(before, after):
        for unit, (shown, factor) in factors.items():
            if one['y'].endswith(unit):
                assert other['y'] == one['y'].replace(unit, shown), other['y']
                assert math.isclose(other['view']['y'][1], one['view']['y'][1] * factor, rel_tol=1e-9)
    browser.run('document.getElementById("units").value = "si"; document.getElementById("units").dispatchEvent(new Event("change"))')
    browser.run('document.getElementById("amplitudes").value = "2"; document.getElementById("amplitudes").dispatchEvent(new Event("change"))')
    after = browser.run(values)
    for one, other in zip(before, after):
        if '0-pk' in one['y']:
            assert 'pk-pk' in other['y'], other['y']
            assert math.isclose(other['series'][0]['y'][0], 2 * one['series'][0]['y'][0], rel_tol=1e-9)
    browser.run('document.getElementById("amplitudes").value = "1"; document.getElementById("amplitudes").dispatchEvent(new Event("change"))')
    keyed = browser.run('(() => { const own = whirl.charts.find((own) => own.spec.sync === "time"); if (!own) return false; own.figure.focus(); return document.activeElement === own.figure; })()')
    if not keyed:
        return
    view = 'whirl.charts.find((own) => own.spec.sync === "time").shownView().x'
    whole = browser.run(view)

    def press(key):
        for kind in ('keyDown', 'keyUp'):
            browser.send('Input.dispatchKeyEvent', type=kind, key=key, text=key if len(key) == 1 and kind == 'keyDown' else '')
    press('+')
    zoomed = browser.run(view)
    assert math.isclose(zoomed[1] - zoomed[0], 0.7 * (whole[1] - whole[0]), rel_tol=1e-6), (whole, zoomed)
    press('ArrowRight')
    assert browser.run('whirl.charts.find((own) => own.spec.sync === "time").cursor') is not None
    press('0')
    assert browser.run(view) == whole


PIXELS = """(() => { whirl.scene.draw(); const { gl } = whirl.scene; const all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all); let sum = 0; for (let k = 0; k < all.length; k++) sum = (31 * sum + all[k]) % 1000003; return sum; })()"""


def turns(browser):
    """The machine in space turns by keys, and moves where it is played."""
    if not browser.run('Boolean(whirl.scene)'):
        return
    browser.run('whirl.scene.canvas.focus()')
    before = browser.run(PIXELS)
    for kind in ('keyDown', 'keyUp'):
        browser.send('Input.dispatchKeyEvent', type=kind, key='ArrowRight')
    assert browser.run(PIXELS) != before, 'it does not turn'
    if browser.run('whirl.scene.frames > 1'):
        before = browser.run(PIXELS)
        browser.run('whirl.scene.time = 1.5')
        assert browser.run(PIXELS) != before, 'it does not move'


LARGE = """(() => { const [around, along, frames] = [250, 200, 24]; const nodes = around * along;
const points = new Float32Array(3 * nodes); const triangles = [];
for (let j = 0; j < along; j++) for (let i = 0; i < around; i++) { const k = j * around + i; const a = 2 * Math.PI * i / around;
  points.set([0.1 * Math.cos(a), 0.1 * Math.sin(a), j / along], 3 * k); const next = j * around + (i + 1) % around;
  if (j + 1 < along) triangles.push(k, next, k + around, next, next + around, k + around); }
const displacement = new Uint16Array(3 * nodes * frames).map((_, k) => 32768 + 30000 * Math.sin(k / 999));
const canvas = document.createElement('canvas'); canvas.style = 'width: 1200px; height: 420px'; document.body.append(canvas);
const motion = { time: [...Array(frames).keys()], angle: [...Array(frames).keys()], displacement: { values: displacement }, largest: 1e-4 };
const scene = new whirl.Scene(canvas, { bodies: [{ name: 'a', turns: true, axis: [0, 0], points: { values: points }, triangles: { values: Uint32Array.from(triangles) }, motion }], left_out: [] });
scene.colour = 'displacement'; const pixel = new Uint8Array(4); const times = [];
for (let k = 0; k < 12; k++) { const begun = performance.now(); scene.time = 0.7 * k; scene.draw(); scene.gl.readPixels(0, 0, 1, 1, scene.gl.RGBA, scene.gl.UNSIGNED_BYTE, pixel); times.push(performance.now() - begun); }
return { nodes, milliseconds: times.sort((a, b) => a - b)[6], fastest: times[0] }; })()"""


def shots(browser, folder, into):
    name, path = os.path.basename(os.path.normpath(folder)), os.path.join(folder, 'report.html')
    for label, width, dark in (('desk', 1400, False), ('phone', 390, False), ('dark', 1400, True)):
        browser.open(path, width, dark=dark)
        browser.run('whirl.charts.forEach((own) => own.render())')
        wide = browser.run('document.documentElement.scrollWidth')
        assert wide <= width, f'{path}: {wide} px wide on a screen of {width} px'
        height = int(browser.run('document.documentElement.scrollHeight'))
        shot = browser.send('Page.captureScreenshot', captureBeyondViewport=True, clip={'x': 0, 'y': 0, 'width': width, 'height': min(height, 16000), 'scale': 1})
        with open(os.path.join(into, f'{name}-{label}.png'), 'wb') as file:
            file.write(base64.b64decode(shot['data']))
    browser.open(path, 1400)
    pdf = browser.send('Page.printToPDF', preferCSSPageSize=True, printBackground=True)
    with open(os.path.join(into, f'{name}.pdf'), 'wb') as file:
        file.write(base64.b64decode(pdf['data']))


def main():
    arguments = sys.argv[1:]
    if not CHROMIUM:
        print('skipped: there is no Chromium here')
        return
    into = None
    if '--shots' in arguments:
        at = arguments.index('--shots')
        into = arguments[at + 1]
        del arguments[at:at + 2]
        os.makedirs(into, exist_ok=True)
    browser = Browser()
    try:
        for folder in arguments:
            if into:
                shots(browser, folder, into)
            charts, compared = check(browser, folder)
            print(f'{folder}: {charts} charts, {compared} values as in history.csv')
        large = browser.run(LARGE)
        print(f'a frame of {large["nodes"]} nodes takes {large["milliseconds"]:.0f} ms, {large["fastest"]:.0f} ms at best')
    finally:
        browser.close()


if __name__ == '__main__':
    main()
