// forms.mjs ROOT: called by forms.sh. Exit code 1 when it printed a fault.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { validate } from 'dockerfile-utils';
import { parseAllDocuments } from 'yaml';

const root = process.argv[2];
const read = (name) => readFileSync(`${root}/${name}`, 'utf8');
const faults = [];

for (const { range, message } of validate(read('docker/Dockerfile')))
  faults.push(`docker/Dockerfile:${range.start.line + 1}: ${message}`);

const objects = [];
for (const file of readdirSync(`${root}/deploy/kubernetes`))
  for (const document of parseAllDocuments(read(`deploy/kubernetes/${file}`), { merge: true })) {
    for (const error of document.errors) faults.push(`${file}: ${error.message}`);
    objects.push({ file, value: document.toJS() });
  }
const kustomization = objects.find(({ value }) => value.kind === 'Kustomization').value;
const listed = objects.filter(({ value }) => value.kind !== 'Kustomization');
for (const { file } of listed)
  if (!kustomization.resources.includes(file)) faults.push(`kustomization.yaml does not list ${file}`);
for (const file of kustomization.resources)
  if (!listed.some((each) => each.file === file)) faults.push(`kustomization.yaml lists ${file}, which does not exist`);

let types = '';
for (const [k, { file, value }] of listed.entries()) {
  const module = `kubernetes-models/${value.apiVersion}/${value.kind}`;
  const { [value.kind]: Model } = await import(module);
  try {
    new Model(value).validate();
  } catch (error) {
    faults.push(`${file}: ${error.message}`);
  }
  types += `import type { I${value.kind} as T${k} } from '${module}';\nexport const object${k}: T${k} = ${JSON.stringify(value, null, 2)};\n`;
}
writeFileSync('manifests.ts', types);

// What belongs together: selectors, ports, the store's place on its volume.
const byKind = Object.fromEntries(listed.map(({ value }) => [value.kind, value]));
const { template, selector, volumeClaimTemplates } = byKind.StatefulSet.spec;
const [container] = template.spec.containers;
const same = (what, ...values) => {
  if (new Set(values.map((each) => JSON.stringify(each))).size !== 1) faults.push(`${what}: ${values.map((each) => JSON.stringify(each)).join(' and ')}`);
};
same('the pods', template.metadata.labels, selector.matchLabels, byKind.Service.spec.selector, byKind.PodDisruptionBudget.spec.selector.matchLabels,
  byKind.NetworkPolicy.spec.podSelector.matchLabels);
const env = Object.fromEntries(container.env.map(({ name, value }) => [name, value]));
const store = env.BAHNWERK_STORE.replace('sqlite:', '');
const mount = container.volumeMounts.find(({ name }) => name === volumeClaimTemplates[0].metadata.name);
if (!store.startsWith(`${mount.mountPath}/`)) faults.push(`the store ${store} is not on the volume ${mount.mountPath}`);
same('the port', env.BAHNWERK_LISTEN.split(':')[1], String(container.ports[0].containerPort), template.metadata.annotations['prometheus.io/port']);
const ports = [byKind.Service.spec.ports[0].targetPort, byKind.NetworkPolicy.spec.ingress[0].ports[0].port];
for (const probe of ['startupProbe', 'livenessProbe', 'readinessProbe']) ports.push(container[probe].httpGet.port);
same('the port\'s name', container.ports[0].name, ...ports);
if (!(Number(env.BAHNWERK_DRAIN_TIMEOUT) + 10 <= template.spec.terminationGracePeriodSeconds)) faults.push('the pod is killed before its drain is over');
if (byKind.StatefulSet.spec.replicas !== 1) faults.push('a SQLite file has one owner');
const user = /^USER (\d+):(\d+)$/m.exec(read('docker/Dockerfile'));
same('the user', [Number(user[1]), Number(user[2])], [template.spec.securityContext.runAsUser, template.spec.securityContext.runAsGroup]);

for (const fault of faults) console.error(fault);
process.exit(faults.length ? 1 : 0);
