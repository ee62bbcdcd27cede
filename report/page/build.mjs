// Bundles the page: node build.mjs SOURCE_FOLDER OUTPUT_FOLDER, run where node_modules is.
//
// Writes page.js (our script, three.js; the licence of every package that
// went in as a comment at its end) and page.css. Fails when the script could not stand inside a page.
import {build} from 'esbuild';
import {existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const [source, output] = process.argv.slice(2);
const modules = join(process.cwd(), 'node_modules');

const common = {
  bundle: true,
  minify: true,
  legalComments: 'none',  // the licences are added as a whole below
  charset: 'utf8',
  logLevel: 'warning',
  write: false,
  nodePaths: [modules],
};
const script = await build({
  ...common,
  entryPoints: [join(source, 'main.js')],
  format: 'iife',
  target: ['es2020'],
  define: {global: 'window'},
  loader: {'.css': 'empty'},  // styles of packages belong to parts that are not used
  metafile: true,
});
const style = await build({...common, entryPoints: [join(source, 'style.css')]});

// "node_modules/@scope/name/lib/file.js" -> "@scope/name"; nested packages by their innermost folder.
function packageOf(input) {
  const parts = input.split('node_modules/');
  if (parts.length < 2) return null;
  const names = parts[parts.length - 1].split('/');
  const name = names[0].startsWith('@') ? names.slice(0, 2).join('/') : names[0];
  return parts.slice(0, -1).join('node_modules/') + 'node_modules/' + name;
}

function notice(folder) {
  const facts = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find((name) => /^(licen[sc]e|copying)/i.test(name));
  const text = file && existsSync(join(folder, file))
      ? readFileSync(join(folder, file), 'utf8').trim()
      : `${facts.license} licence; the package carries no text of its own.`;
  return `${facts.name} ${facts.version}\n\n${text}`;
}

const bundle = script.outputFiles[0].text;
const used = Object.entries(script.metafile.outputs)[0][1].inputs;
const folders = new Set(Object.entries(used)
                            .filter(([, part]) => part.bytesInOutput > 0)
                            .map(([input]) => packageOf(input))
                            .filter((folder) => folder !== null));
const notices = [...folders].sort().map(notice).join('\n\n----------\n\n');
const comment = `/*! Packages in this script and their licences\n\n${
    notices.replaceAll('*/', '* /').replaceAll('</', '< /').replaceAll('<!--', '< !--')}\n*/\n`;
const page = bundle + comment;

for (const unwanted of ['</script', '<!--', 'src="http', "src='http"]) {
  if (page.toLowerCase().includes(unwanted)) throw new Error(`the bundle contains ${unwanted}`);
}
mkdirSync(output, {recursive: true});
writeFileSync(join(output, 'page.js'), page);
writeFileSync(join(output, 'page.css'), style.outputFiles[0].text);
